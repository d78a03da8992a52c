// Values between particles, wherever these stand.
#pragma once

#include <hyperlattice/output.hpp>

#include <vector>

namespace hyperlattice::line {

struct Share {
  Particle particle = 0;
  double weight = 0;
};

/// What each particle counts in the value at a point: the affine function that fits those within
/// `radius` best is asked there. Near ones count most, so that at a particle the value is its own
/// but for a millionth of what its neighbours differ. Affine fields come out exactly, also outside
/// of the particles and where they stand on one side; along a direction in which all of them stand
/// in a line or plane, the function is constant. Weights add up to 1. Empty if no particle is
/// within the radius. `spacing` is the lattice's.
std::vector<Share> shares_at(Vec3 point, double spacing, double radius, const Snapshot& snapshot,
                             const std::vector<Particle>& among);

}  // namespace hyperlattice::line
