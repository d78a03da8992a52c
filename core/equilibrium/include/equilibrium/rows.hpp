// The innermost loops of the solver, compiled once for each instruction set. The interface has
// plain pointers only, because the compiled variants must not share any inline function.
#pragma once

#include <cstdint>

namespace hyperlattice::equilibrium {

/// The springs of one row to one neighbour, with their tangents, N/m. Tangents are in single
/// precision: each spring changes a little, the balance of the forces does not. Fields are in
/// double precision, because those of a slender body are smooth to more digits than single
/// precision has. Pointers point to the row's first place; the other ends are `step` places further
/// on. Lengths are in lattice constants.
struct RowOfSprings {
  std::int64_t count = 0, step = 0;
  const float *axial = nullptr, *pull = nullptr, *cross_axial = nullptr,
              *cross_pull = nullptr;  ///< pull and cross_pull are null in an undeformed body
  const float* moved[4] = {};         ///< displacements
  float rest[3] = {}, membrane_distance = 0;
};

/// The direction of a neighbour: the step in places, and the vector at rest in lattice constants.
struct Direction {
  std::int64_t step = 0;
  double rest[3] = {};
};

/// The product of K and a field for all springs of a row; pointers point to its first place.
struct SpringProduct {
  std::int64_t count = 0;
  int neighbours = 0;
  const Direction* to = nullptr;
  double membrane_distance = 0;
  const float* tangents = nullptr;  ///< see TangentRows
  const float* moved[4] = {};  ///< displacements in lattice constants; null: the body is undeformed
  const double* in[4] = {};
  double* out[4] = {};  ///< the product is added to these
};

/// The product of the tangents of the cells of one row (cell_tangent.hpp) and a field; pointers
/// point to the row's first place.
struct CellProduct {
  std::int64_t count = 0, row = 0, plane = 0;  ///< cells; steps to the next row and plane
  const float *stiffness = nullptr,
              *pressure = nullptr;  ///< pressure is null in an undeformed body
  const float* moved[3] = {};       ///< displacements in lattice constants
  const double* in[3] = {};
  double* out[3] = {};  ///< the product is added to these
};

/// The upper triangles of the symmetric blocks of some places, row by row, [number][place]: 10
/// numbers with heights, else 6.
inline constexpr int most_in_triangle = 10;
struct Triangles {
  float* numbers[most_in_triangle] = {};
};

/// The product of the inverse blocks of some places, stored like Triangles, and a field,
/// [component][place].
struct Division {
  std::int64_t count = 0;
  const float* inverse[most_in_triangle] = {};
  const double* in[4] = {};
  double* out[4] = {};
};

/// The product of a row of a coarse level and a field, with blocks of 4 x 4 numbers, [a][b].
struct StencilProduct {
  std::int64_t count = 0;               ///< sites of the row
  int neighbours = 0;                   ///< number of forward neighbours
  const std::int64_t* steps = nullptr;  ///< step to each forward neighbour, places
  const double* blocks =
      nullptr;  ///< for each kind of site: the diagonal block, then those to forward neighbours
  const std::int32_t* kind = nullptr;  ///< kind of each place, from the row's first place on
  const double* in = nullptr;          ///< 4 numbers per place, from the row's first place on
  double* out = nullptr;
};

/// The contribution of a spring to one block of the coarser level: the weights of its tangents.
struct CoarsePart {
  std::int64_t place;      ///< place of the block, relative to the spring's
  std::int64_t neighbour;  ///< neighbour to which the block leads
  double base[16], cross[16];
};

/// The blocks of a coarse level while they are summed, from the place of a spring on.
struct BlockSums {
  double* blocks = nullptr;              ///< blocks of all kinds
  const std::int32_t* making = nullptr;  ///< kind whose blocks are summed at a place; below 0: none
  std::int64_t stride = 0;               ///< number of blocks of a kind
};

struct RowKernels {
  /// Adds K times a field. Reads and adds zeros up to seven places beyond the row.
  void (*springs)(const SpringProduct&, int components) = nullptr;
  /// Adds the tangents of cells times a field. Reads and adds zeros up to seven places beyond the
  /// row.
  void (*cells)(const CellProduct&) = nullptr;
  /// Adds the contributions of springs to the diagonal blocks of both ends.
  void (*diagonal)(const RowOfSprings&, int components, const Triangles&) = nullptr;
  /// Replaces each block by its inverse, with zeros for components that are held (bit of `free` is
  /// 0) or have no stiffness.
  void (*invert)(std::int64_t count, int components, const std::uint8_t* free,
                 const Triangles&) = nullptr;
  void (*divide)(const Division&, int components) = nullptr;
  void (*stencil)(const StencilProduct&) = nullptr;
  void (*add_spring)(const BlockSums&, const CoarsePart* parts, int count, const double* base,
                     const double* cross) = nullptr;
  /// block[16] += factor * other[16]
  void (*add_block)(double* block, double factor, const double* other) = nullptr;
};

const RowKernels& row_kernels();  ///< Returns the kernels for this processor.

}  // namespace hyperlattice::equilibrium
