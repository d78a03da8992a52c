// The reference kernel: the forces of one spring in plain numbers, as the theory states them. Every
// other kernel computes the same forces faster, and is tested against this one
// (tests/truth/reference_kernel_test.cpp).
//
//   r = R + u_b - u_a                      vector between the ends in space; R at rest
//   base spring:  g = h_b - h_a,           L = sqrt(|r|^2 + g^2),
//                 force f(L - L0) on a along (r, g) / L, on b the opposite
//   cross spring: s = Delta + h_a + h_b,   L = sqrt(|r|^2 + s^2),
//                 force f(L - Lc) on a along (r, -s) / L, on b along (-r, -s) / L
//
// with the displacements u, the heights h, and the distance Delta to the mirror copy. See
// docs/theory/mirror.md.
#pragma once

#include <hyperlattice/plain.hpp>

#include <array>
#include <cmath>

namespace hyperlattice {

/// Displacement and height of a particle, m, or the force on it, N.
using FourVector = std::array<double, 4>;

/// Adds the forces, N, of a base spring, and of its cross spring if `has_cross`, to the forces on
/// its ends. `respond(cross, rest_length, elongation)` returns the law's force, N. Without a
/// membrane heights are 0.
template <class Respond>
void add_reference_forces(Vec3 rest, double membrane_distance, bool has_cross, const FourVector& a,
                          const FourVector& b, const Respond& respond, FourVector& on_a,
                          FourVector& on_b) {
  const Vec3 r = rest + Vec3{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  for (const bool cross : {false, true}) {
    if (cross && !has_cross) continue;
    const double rest_length = std::hypot(norm(rest), cross ? membrane_distance : 0.0);
    const double rise = cross ? membrane_distance + a[3] + b[3] : b[3] - a[3];
    const double length = std::hypot(norm(r), rise);
    const double pull = respond(cross, rest_length, length - rest_length) / length;
    const double along[3] = {pull * r.x, pull * r.y, pull * r.z};
    for (std::size_t c = 0; c < 3; ++c) {
      on_a[c] += along[c];
      on_b[c] -= along[c];
    }
    on_a[3] += cross ? -pull * rise : pull * rise;
    on_b[3] -= pull * rise;
  }
}

/// Adds the force, N, of the alpha spring between a particle and its own mirror copy, of length
/// Delta + 2 h.
inline void add_reference_alpha(double alpha, const FourVector& particle, FourVector& force) {
  force[3] -= 2 * alpha * particle[3];
}

}  // namespace hyperlattice
