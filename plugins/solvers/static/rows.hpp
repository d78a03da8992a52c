// The innermost loops of the solver, compiled for each instruction set. Plain pointers only:
// nothing here may be shared between the variants.
#pragma once

#include <cstdint>

namespace hyperlattice::statics {

/// The springs of one row to one neighbour, with their tangents. These are in single precision,
/// which changes each spring a little and none of what they do together; the fields that they
/// multiply are not: of a slender body they are smooth to more digits than that. Pointers are at
/// the row's first place; the other ends are `step` places on. Lengths are in lattice constants.
struct RowOfSprings {
  std::int64_t count = 0, step = 0;
  const float *axial = nullptr, *pull = nullptr, *cross_axial = nullptr,
              *cross_pull = nullptr;  ///< pulls null: the body is undeformed
  const float* moved[4] = {};         ///< displacements
  float rest[3] = {}, membrane_distance = 0;
};

/// Where a neighbour is: in places, and in lattice constants.
struct Direction {
  std::int64_t step = 0;
  double rest[3] = {};
};

/// K times a field, of all springs of a row; pointers are at its first place.
struct SpringProduct {
  std::int64_t count = 0;
  int neighbours = 0;
  const Direction* to = nullptr;
  double membrane_distance = 0;
  const float* tangents = nullptr;  ///< see TangentRows
  const float* moved[4] = {};  ///< displacements in lattice constants; null: the body is undeformed
  const double* in[4] = {};
  double* out[4] = {};  ///< the product is added
};

/// The upper triangle of a symmetric block of each place, row by row: 10 numbers with heights,
/// or 6.
inline constexpr int most_in_triangle = 10;
struct Triangles {
  float* numbers[most_in_triangle] = {};
};

/// The inverse blocks of some places, like Triangles, times a field's numbers there, by component.
struct Division {
  std::int64_t count = 0;
  const float* inverse[most_in_triangle] = {};
  const double* in[4] = {};
  double* out[4] = {};
};

/// Blocks of 4 x 4 numbers, [a][b].
struct StencilProduct {
  std::int64_t count = 0;               ///< sites of the row
  int neighbours = 0;                   ///< forward ones
  const std::int64_t* steps = nullptr;  ///< to each, in places
  const double* blocks =
      nullptr;  ///< of each kind of site: its own, then those to its forward neighbours
  const std::int32_t* kind = nullptr;  ///< of the row's first place
  const double* in = nullptr;          ///< 4 numbers a place, of the row's first
  double* out = nullptr;
};

/// What a spring adds to one block of the coarser level: its tangents, each number times a weight.
struct CoarsePart {
  std::int64_t place;      ///< of the block, from where the spring stands
  std::int64_t neighbour;  ///< to which the block leads
  double base[16], cross[16];
};

/// Blocks in the making, from where a spring stands.
struct BlockSums {
  double* blocks = nullptr;              ///< of each kind
  const std::int32_t* making = nullptr;  ///< which kind's blocks are made at a place; below 0: none
  std::int64_t stride = 0;               ///< blocks of a kind
};

struct RowKernels {
  /// Reads and adds zeros up to seven places beyond the row.
  void (*springs)(const SpringProduct&, int components) = nullptr;
  /// Adds what springs have in the diagonal blocks of both ends.
  void (*diagonal)(const RowOfSprings&, int components, const Triangles&) = nullptr;
  /// Each block becomes its inverse, with zeros for what is not free (bits) or has no stiffness.
  void (*invert)(std::int64_t count, int components, const std::uint8_t* free,
                 const Triangles&) = nullptr;
  void (*divide)(const Division&, int components) = nullptr;
  void (*stencil)(const StencilProduct&) = nullptr;
  void (*add_spring)(const BlockSums&, const CoarsePart* parts, int count, const double* base,
                     const double* cross) = nullptr;
  /// block[16] += factor * other[16]
  void (*add_block)(double* block, double factor, const double* other) = nullptr;
};

const RowKernels& row_kernels();  ///< for this processor

}  // namespace hyperlattice::statics
