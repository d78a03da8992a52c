#include <state/load_forces.hpp>

namespace hyperlattice {

PresentLoads present_loads(const BlockSet& blocks, double last_step, const RestLoads* at_rest) {
  PresentLoads loads;
  loads.acceleration =
      (at_rest != nullptr ? at_rest->gravity : 1) * blocks.model().loads.acceleration;
  for (const Block& block : blocks) {
    const std::size_t first = loads.particles.size();
    loads.particles.resize(first + block.boundary_particles.size());
    for (std::size_t s = 0; s < block.boundary_particles.size(); ++s) {
      const BoundaryParticle& support = block.boundary_particles[s];
      LoadOnParticle& on = loads.particles[first + s];
      on.prescribed = static_cast<Axes>(support.axes);
      for (int c = 0; c < 3 && last_step > 0; ++c)
        // A measurement's velocity is that after a kick of the length of the last step.
        if ((support.axes >> c & 1U) != 0)
          on.acceleration[c] = (support.velocity[c] - block.velocity[c][support.index]) / last_step;
    }
    for (const Contribution& part : block.contributions) {
      LoadOnParticle& on = loads.particles[first + part.support];
      const bool answers = part.watched != not_watched;
      on.particle = part.particle;
      on.force +=
          (at_rest != nullptr && !answers ? at_rest->factor[part.load] : part.factor) * part.force;
    }
  }
  return loads;
}

}  // namespace hyperlattice
