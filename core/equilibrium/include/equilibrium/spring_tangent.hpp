// The tangent of one base spring and of its cross spring as 4 x 4 blocks,
//   K = axial r r^T + pull I,
// with the vector r between the ends in lattice constants (kernels/tangent.hpp).
#pragma once

namespace hyperlattice::equilibrium {

/// The tangent of a spring, N/m, see SpringTangents; 0 if there is no spring.
struct SpringNumbers {
  float axial = 0, pull = 0, cross_axial = 0, cross_pull = 0;
};

/// The 4 x 4 blocks, row by row: K_base acts on the difference of the ends; K_cross acts on the
/// difference of displacements and the sum of heights.
struct SpringBlocks {
  double base[16], cross[16];

  /// r: vector from end to end, with the difference of heights; total: Delta plus both heights; all
  /// in lattice constants. heights: whether the membrane is free.
  SpringBlocks(const SpringNumbers& numbers, const float (&r)[4], float total, bool heights) {
    const float q[4] = {r[0], r[1], r[2], total};
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b) {
        const float unit = a == b && (a < 3 || heights) ? 1.0f : 0.0f;
        base[4 * a + b] =
            double(numbers.axial) * double(r[a]) * double(r[b]) + double(numbers.pull * unit);
        cross[4 * a + b] = double(numbers.cross_axial) * double(q[a]) * double(q[b]) +
                           double(numbers.cross_pull * unit);
      }
  }
  SpringBlocks() = default;
};

}  // namespace hyperlattice::equilibrium
