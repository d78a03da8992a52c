// The forces of loads on the body, in the state that was measured last. The force of a prescribed
// motion is its reaction,
//   R = m a - F,
// along each prescribed axis: a is the prescribed acceleration over the half step before now, and F
// the sum of all other forces on the particle. At rest it is minus the internal force, less other
// loads on the same particle.
#pragma once

#include <state/acting_loads.hpp>
#include <state/block_set.hpp>
#include <state/clock.hpp>
#include <state/simulation.hpp>

#include <hyperlattice/output.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace hyperlattice {

/// Returns the force of all loads on every particle, N, once Sweeps::set_loads() has set the loads
/// of the present state. Along a prescribed axis it is m a less the internal force. `internal`
/// gives the internal forces, N; it is called only if a load prescribes motion.
std::vector<Vec3> external_forces(const BlockSet& blocks, const Clock& clock,
                                  const ActingLoads& loads,
                                  const Simulation::ForcesOnAll& internal);

class ExternalForces {
 public:
  /// The forces of one load.
  ExternalForces(const BlockSet& blocks, const Clock& clock, const ActingLoads& loads,
                 std::size_t load);
  /// The forces of all loads on these particles, which are ascending.
  ExternalForces(const BlockSet& blocks, const Clock& clock, const ActingLoads& loads,
                 std::span<const Particle> particles);

  /// Returns their sum, with the moment about a point, m.
  Resultant sum(Vec3 about) const;

 private:
  struct Part {
    const Block* block = nullptr;
    std::size_t contribution = 0;
  };
  template <class Chosen>
  void choose(const Chosen& chosen);
  Vec3 force_of(const Block& block, const Contribution& part) const;
  void add_weight(Vec3 about, Resultant& sum) const;

  const BlockSet& blocks_;
  const Model& model_;
  const Clock& clock_;
  const ActingLoads& loads_;
  std::vector<Part> parts_;      ///< in the order of the particles, for any number of blocks
  Vec3 acceleration_;            ///< m/s2
  std::vector<Particle> heavy_;  ///< on which it acts; empty: all
};

}  // namespace hyperlattice
