#include <state/external_forces.hpp>
#include <state/load_work.hpp>

#include <algorithm>

namespace hyperlattice {

std::vector<Vec3> external_forces(const BlockSet& blocks, const Clock& clock,
                                  const ActingLoads& loads,
                                  const Simulation::ForcesOnAll& internal) {
  const Model& model = blocks.model();
  std::vector<Vec3> forces(model.body.particles);
  const Vec3 gravity = loads.gravity() * model.loads.acceleration;
  if (!(gravity == Vec3{}))
    for (Particle p = 0; p < forces.size(); ++p) forces[p] = model.mass(p) * gravity;
  for (const Block& block : blocks) {
    std::uint32_t next = 0;  // support, so that each is visited once
    for (const Contribution& part : block.contributions) {
      if (part.support != next) continue;
      const BoundaryParticle& support = block.boundary_particles[next++];
      Vec3& force = forces[part.particle];
      force += support.force;
      for (int c = 0; c < 3; ++c)
        if ((support.axes >> c & 1U) != 0)
          // A measurement's velocity is that after a kick of the length of the last step.
          force[c] =
              support.mass * acceleration_in(clock.last_step(), block.velocity[c][support.index],
                                             support.velocity[c]) -
              internal()[part.particle][c];
    }
  }
  return forces;
}

ExternalForces::ExternalForces(const BlockSet& blocks, const Clock& clock, const ActingLoads& loads,
                               std::size_t load)
    : blocks_(blocks),
      model_(blocks.model()),
      clock_(clock),
      loads_(loads),
      acceleration_(model_.loads[load].acceleration) {
  choose([&](const Contribution& part) { return part.load == load; });
}

ExternalForces::ExternalForces(const BlockSet& blocks, const Clock& clock, const ActingLoads& loads,
                               std::span<const Particle> particles)
    : blocks_(blocks),
      model_(blocks.model()),
      clock_(clock),
      loads_(loads),
      acceleration_(model_.loads.acceleration) {
  choose([&](const Contribution& part) {
    return std::binary_search(particles.begin(), particles.end(), part.particle);
  });
  if (acceleration_ == Vec3{} || particles.size() == model_.body.particles) return;
  heavy_.assign(particles.begin(), particles.end());
}

template <class Chosen>
void ExternalForces::choose(const Chosen& chosen) {
  for (const Block& block : blocks_)
    for (std::size_t n = 0; n < block.contributions.size(); ++n)
      if (chosen(block.contributions[n])) parts_.push_back({&block, n});
}

/// Returns the force of a load on a particle: what it pushes with, and the reaction along the axes
/// that it prescribes.
Vec3 ExternalForces::force_of(const Block& block, const Contribution& part) const {
  const BoundaryParticle& support = block.boundary_particles[part.support];
  Vec3 force = part.factor * part.force;
  for (int c = 0; c < 3; ++c) {
    if (((part.displaced | part.driven) >> c & 1u) == 0) continue;
    const double not_acting = (1 - loads_.gravity()) * model_.loads.acceleration[c];
    force[c] += reaction(block, part, c, support.velocity[c], clock_.last_step()) +
                model_.mass(part.particle) * not_acting;
  }
  return force;
}

void ExternalForces::add_weight(Vec3 about, Resultant& sum) const {
  if (acceleration_ == Vec3{}) return;
  double mass = 0;
  Vec3 first_moment;  // kg m
  auto next = heavy_.begin();
  blocks_.for_runs(
      [&](const Block& block, std::uint64_t place, Particle first, std::uint64_t count) {
        for (std::uint64_t n = 0; n < count; ++n) {
          const Particle particle = first + n;
          if (!heavy_.empty()) {
            if (next == heavy_.end() || *next != particle) continue;
            ++next;
          }
          const auto moved = [&](int c) { return block.displacement[c][place + n]; };
          const double m = model_.mass(particle);
          mass += m;
          first_moment +=
              m * (model_.body.position(particle) + Vec3{moved(0), moved(1), moved(2)} - about);
        }
      });
  sum.force += loads_.gravity() * mass * acceleration_;
  sum.moment += loads_.gravity() * cross(first_moment, acceleration_);
}

Resultant ExternalForces::sum(Vec3 about) const {
  Resultant total;
  for (const auto& [block, contribution] : parts_) {
    const Contribution& part = block->contributions[contribution];
    const std::uint64_t index = block->boundary_particles[part.support].index;
    const auto moved = [&, &of = *block](int c) { return of.displacement[c][index]; };
    const Vec3 force = force_of(*block, part), arm = model_.body.position(part.particle) +
                                                     Vec3{moved(0), moved(1), moved(2)} - about;
    total.force += force;
    total.moment += cross(arm, force);
  }
  add_weight(about, total);
  return total;
}

}  // namespace hyperlattice
