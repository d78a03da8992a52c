// Tells whether the stiffness of a membrane's heights has changed much.
#pragma once

namespace hyperlattice::statics {

/// A spring of length L with the force f adds f / L, N/m, to the stiffness against a difference of
/// its ends' heights. In a soft membrane this is soon more than the stiffness of the membrane.
/// `pulls`: the sum of the largest f / L before and now; `softest`: the least stiffness of a
/// height, N/m. Returns true at strains of about 0.02 for lambda = 1, in proportion to lambda.
inline bool holds_heights_otherwise(double pulls, double softest) {
  constexpr double joined = 18, little = 0.1;  // springs of a particle; fraction of the stiffness
  return joined * pulls > little * softest;
}

}  // namespace hyperlattice::statics
