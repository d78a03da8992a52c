// The tangent of one spring, and of the cross spring beside it, as blocks.
#pragma once

namespace hyperlattice::statics {

/// What a spring is, in N/m, see SpringTangents; 0 where there is none.
struct SpringNumbers {
  float axial = 0, pull = 0, cross_axial = 0, cross_pull = 0;
};

/// K_base on differences of ends, K_cross where heights add up, both row by row in 4 x 4.
struct SpringBlocks {
  double base[16], cross[16];

  /// r: from end to end, with the difference of heights; total: Delta and the heights' sum; all in
  /// lattice constants. heights: whether membranes can move.
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

}  // namespace hyperlattice::statics
