// Interpolation between the particles of any lattice by weighted least squares.
#pragma once

#include <hyperlattice/output.hpp>

#include <vector>

namespace hyperlattice::line {

struct Share {
  Particle particle = 0;
  double weight = 0;
};

/// Returns the weight of each particle in the value at a point, m: the value of the affine function
/// that fits the particles within `radius`, m, best. Near particles count most: at a particle the
/// value is its own, up to a millionth of the difference to its neighbours. Affine fields are
/// exact, also outside the particles. If all particles lie in a line or plane, the function is
/// constant normal to it. Weights add up to 1. Empty if no particle is within the radius.
/// `spacing`: that of the lattice, m.
std::vector<Share> shares_at(Vec3 point, double spacing, double radius, const Snapshot& snapshot,
                             const std::vector<Particle>& among);

}  // namespace hyperlattice::line
