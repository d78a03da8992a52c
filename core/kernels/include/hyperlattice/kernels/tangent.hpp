// The springs of one row for a static solver: force over length of each spring, and its tangent.
//
// For a spring with the vector r between its ends, length L, force f(L - L0) and derivative f', the
// tangent with respect to the difference of its ends is
//   K = axial r r^T / l^2 + pull I,   pull = f / L,   axial = (f' - f / L) l^2 / L^2,
// with the lattice constant l, so that both are in N/m. The force is pull r. The same holds for
// cross springs, with the fourth component Delta + h_i + h_j. See docs/theory/statics.md.
#pragma once

#include <hyperlattice/kernels/springs.hpp>

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

/// Returns the derivative of the law's force, N/m: the law's own tangent(); the stiffness of a
/// linear law; else a central difference.
template <class Law>
inline Pack tangent_of(Pack stiffness, Pack elongation, double rest_length) {
  if constexpr (requires { Law::tangent(stiffness, elongation); }) {
    return Law::tangent(stiffness, elongation);
  } else if constexpr (is_linear<Law>) {
    return stiffness;
  } else {
    const double h = 1e-6 * rest_length;
    return (Law::force(stiffness, elongation + h) - Law::force(stiffness, elongation - h)) /
           (2 * h);
  }
}

template <class Law, Membrane membrane>
struct Tangent {
  /// Writes pull and axial of the springs. Returns their stored energy, J.
  static double run(const SpringRow& row) {
    Pack stored{};
    for (int t = 0; t < row.count; t += lanes) {
      const Pack weight = load(row.weight + t);
      Pack difference{}, total{};  // difference and sum of the heights
      Pack q{};
      const double rest[3] = {row.rest.x, row.rest.y, row.rest.z};
      for (int c = 0; c < 3; ++c) {
        const Pack d = load(row.there[c] + t) - load(row.here[c] + t);
        q += d * (2 * rest[c] + d);
      }
      if constexpr (membrane == Membrane::free) {
        const Pack here = load(row.here[3] + t), there = load(row.there[3] + t);
        difference = there - here;
        total = there + here;
      }
      stored += one(row, row.rest_length, load(row.stiffness + t), q + difference * difference,
                    weight, row.pull + t, row.axial + t);
      if constexpr (membrane != Membrane::none) {
        const Pack growth = q + total * (2 * row.membrane_distance + total);
        stored += one(row, row.cross_rest_length, load(row.cross_stiffness + t), growth, weight,
                      row.cross_pull + t, row.cross_axial + t);
      }
    }
    return sum(stored);
  }

 private:
  static Pack one(const SpringRow& row, double rest_length, Pack stiffness, Pack q, Pack weight,
                  double* pull, double* axial) {
    const Pack square = rest_length * rest_length + q, length = root(square),
               elongation = q / (length + rest_length);
    const Pack force_over_length = Law::force(stiffness, elongation) / length;
    const Pack along = (tangent_of<Law>(stiffness, elongation, rest_length) - force_over_length) *
                       (row.spacing * row.spacing) / square;
    const LanesOf<double> there_is =
        not_zero(weight);  // missing springs have values that may not be finite
    store(pull, where(there_is, weight * force_over_length));
    store(axial, where(there_is, weight * along));
    return where(there_is, weight * Law::energy(stiffness, elongation));
  }
};

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS
