// The innermost loops of the solver, compiled for each instruction set. Plain pointers only: nothing here may be shared between the variants.
#pragma once

#include <cstdint>

namespace hyperlattice::statics {

/// The springs of one row to one neighbour, and the product of their tangents with a field. Pointers are at the row's first place; the other ends are
/// `step` places on. Lengths are in lattice constants.
template <class Real>
struct SpringProduct {
  std::int64_t count = 0, step = 0;
  const float *axial = nullptr, *pull = nullptr, *cross_axial = nullptr, *cross_pull = nullptr;  ///< pulls null: the body is undeformed
  const float* moved[4] = {};                                                                     ///< displacements
  float rest[3] = {}, membrane_distance = 0;
  const Real* in[4] = {};
  Real* out[4] = {};  ///< K times in is added
};

/// Blocks of 4 x 4 floats, [a][b].
struct StencilProduct {
  std::int64_t count = 0;       ///< sites of the row
  int neighbours = 0;           ///< forward ones
  const std::int64_t* steps = nullptr;  ///< to each, in places
  const float* blocks = nullptr;        ///< of the row's first place: its own, then those to its forward neighbours
  const float* in = nullptr;            ///< 4 numbers a place, of the row's first
  float* out = nullptr;
};

struct RowKernels {
  void (*springs_float)(const SpringProduct<float>&, int components) = nullptr;
  void (*springs_double)(const SpringProduct<double>&, int components) = nullptr;
  void (*stencil)(const StencilProduct&) = nullptr;
  /// block[16] += factor * other[16]; and the same of the other's transpose
  void (*add_block)(float* block, float factor, const float* other) = nullptr;
};

const RowKernels& row_kernels();  ///< for this processor

}  // namespace hyperlattice::statics
