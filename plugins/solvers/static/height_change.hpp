// Whether a membrane's heights are held otherwise than before.
#pragma once

namespace hyperlattice::statics {

/// A spring that pulls with the force f over its length L adds f / L, N/m, to what holds the
/// difference of its ends' heights. Of a soft membrane that is soon more than its own springs give.
/// pulls: the largest f / L, before and now together; softest: what holds the height that is held
/// least, N/m. True at strains of about 0.02 for lambda = 1, in proportion to lambda.
inline bool holds_heights_otherwise(double pulls, double softest) {
  constexpr double joined = 18, little = 0.1;  // springs of a particle; share
  return joined * pulls > little * softest;
}

}  // namespace hyperlattice::statics
