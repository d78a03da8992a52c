// The forces and the prescribed motion of loads at the present time, without an evaluation of the
// springs.
#pragma once

#include <state/block_set.hpp>

#include <vector>

namespace hyperlattice {

/// All that loads but body accelerations do to one particle.
struct LoadOnParticle {
  Particle particle = 0;
  Vec3 force;           ///< N
  Axes prescribed = 0;  ///< axes along which a load moves or holds the particle
  Vec3 acceleration;    ///< of the prescribed motion, m/s2; 0 at rest
};
struct PresentLoads {
  std::vector<LoadOnParticle> particles;  ///< each once
  Vec3 acceleration;                      ///< of every particle, m/s2
};

/// Fractions of the loads' amplitudes that act in a state of rest.
struct RestLoads {
  std::vector<double> factor;  ///< one per load
  double gravity = 1;          ///< of the body accelerations
};

/// Returns the forces that the last evaluation gave to the blocks' boundary particles.
/// `last_step`: length of the last step, s. `at_rest`: the fractions, if the body is at rest; else
/// null.
PresentLoads present_loads(const BlockSet& blocks, double last_step, const RestLoads* at_rest);

}  // namespace hyperlattice
