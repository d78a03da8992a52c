// Tells whether stiffness other than that of springs has changed much: of a membrane's heights, and
// of inertia.
#pragma once

#include <algorithm>
#include <cmath>

namespace hyperlattice::equilibrium {

/// A spring of length L with the force f adds f / L, N/m, to the stiffness against a difference of
/// its ends' heights. In a soft membrane this is soon more than the stiffness of the membrane.
/// `pulls`: the sum of the largest f / L before and now; `softest`: the least stiffness of a
/// height, N/m. Returns true at strains of about 0.02 for lambda = 1, in proportion to lambda.
inline bool holds_heights_otherwise(double pulls, double softest) {
  constexpr double joined = 18, little = 0.1;  // springs of a particle; fraction of the stiffness
  return joined * pulls > little * softest;
}

/// Returns whether inertia has changed so much that coarse levels serve no longer. `before` and
/// `now`: the largest stiffness of a number against its own change, N/m.
inline bool holds_numbers_otherwise(double before, double now) {
  constexpr double little = 0.2;
  return std::abs(now - before) > little * std::max(before, now);
}

}  // namespace hyperlattice::equilibrium
