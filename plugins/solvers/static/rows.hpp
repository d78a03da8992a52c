// The innermost loops of the solver, compiled for each instruction set. Plain pointers only: nothing here may be shared between the variants.
#pragma once

#include <cstdint>

namespace hyperlattice::statics {

/// The springs of one row to one neighbour, with their tangents. These are in single precision, which changes each spring a little and none of what
/// they do together; the fields that they multiply are not: of a slender body they are smooth to more digits than that. Pointers are at the row's
/// first place; the other ends are `step` places on. Lengths are in lattice constants.
struct RowOfSprings {
  std::int64_t count = 0, step = 0;
  const float *axial = nullptr, *pull = nullptr, *cross_axial = nullptr, *cross_pull = nullptr;  ///< pulls null: the body is undeformed
  const float* moved[4] = {};                                                                    ///< displacements
  float rest[3] = {}, membrane_distance = 0;
};

/// K times a field, at the row's first place.
struct SpringProduct {
  const double* in[4] = {};
  double* out[4] = {};  ///< the product is added
};

/// The upper triangle of a symmetric block of each place, row by row: 10 numbers with heights, or 6.
inline constexpr int most_in_triangle = 10;
struct Triangles {
  float* numbers[most_in_triangle] = {};
};

/// Blocks of 4 x 4 numbers, [a][b].
struct StencilProduct {
  std::int64_t count = 0;               ///< sites of the row
  int neighbours = 0;                   ///< forward ones
  const std::int64_t* steps = nullptr;  ///< to each, in places
  const double* blocks = nullptr;       ///< of the row's first place: its own, then those to its forward neighbours
  const double* in = nullptr;           ///< 4 numbers a place, of the row's first
  double* out = nullptr;
};

/// What a spring adds to one block of the coarser level: its tangents, each number times a weight.
struct CoarsePart {
  std::int64_t block;  ///< place of the block, in numbers from where the spring stands
  double base[16], cross[16];
};

struct RowKernels {
  void (*springs)(const RowOfSprings&, int components, const SpringProduct&) = nullptr;
  /// Adds what springs have in the diagonal blocks of both ends.
  void (*diagonal)(const RowOfSprings&, int components, const Triangles&) = nullptr;
  /// Each block becomes its inverse, with zeros for what is not free (bits) or has no stiffness.
  void (*invert)(std::int64_t count, int components, const std::uint8_t* free, const Triangles&) = nullptr;
  void (*stencil)(const StencilProduct&) = nullptr;
  void (*add_spring)(double* blocks, const CoarsePart* parts, int count, const double* base, const double* cross) = nullptr;
  /// block[16] += factor * other[16]
  void (*add_block)(double* block, double factor, const double* other) = nullptr;
};

const RowKernels& row_kernels();  ///< for this processor

}  // namespace hyperlattice::statics
