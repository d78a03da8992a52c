#include <state/load_work.hpp>

#include <cmath>

namespace hyperlattice {
namespace {

/// Returns the vector with its components along all other axes set to zero.
Vec3 along(Axes axes, Vec3 v) {
  return {(axes & 1u) != 0 ? v.x : 0, (axes & 2u) != 0 ? v.y : 0, (axes & 4u) != 0 ? v.z : 0};
}

}  // namespace

void count_work(Block& block) {
  for (Contribution& part : block.contributions) {
    const BoundaryParticle& support = block.boundary_particles[part.support];
    part.work += part.factor * dot(part.force, support.path);
    if (support.axes != 0)
      part.held_work += part.factor * dot(part.force, along(support.axes, support.path));
  }
}

void count_work(BlockSet& blocks, const EquilibriumUpdate& to) {
  const Model& model = blocks.model();
  const auto moved_of = [&](const Block& block, const BoundaryParticle& support,
                            Particle particle) {
    const auto way = [&](std::size_t c) {
      return to.xyz[3 * particle + c] - block.displacement[c][support.index];
    };
    return Vec3{way(0), way(1), way(2)};
  };
  for (std::size_t l = 0; l < model.loads.size(); ++l) {
    const double mean = 0.5 * (to.factor_before[l] + to.factor[l]);
    for (Block& block : blocks)
      for (Contribution& part : block.contributions) {
        if (part.load != l) continue;
        BoundaryParticle& support = block.boundary_particles[part.support];
        const Particle particle = part.particle;
        const Vec3 moved = moved_of(block, support, particle);
        part.work += mean * dot(part.force, moved);
        part.held_work += mean * dot(part.force, along(support.axes, moved));
        for (int c = 0; c < 3; ++c) {
          const std::size_t n = 3 * particle + static_cast<std::size_t>(c);
          if (((part.displaced | part.driven) >> c & 1u) != 0)
            support.reaction_work -= 0.5 * (to.force[n] + to.force_before[n]) * moved[c];
        }
      }
  }
}

std::vector<double> work_by_load(const BlockSet& blocks, double potential) {
  const Model& model = blocks.model();
  std::vector<double> work(model.loads.size(), 0);
  for (const Block& block : blocks) {
    std::vector<double> held(block.boundary_particles.size(), 0);
    for (const Contribution& part : block.contributions) {
      const BoundaryParticle& support = block.boundary_particles[part.support];
      work[part.load] += part.work + part.factor * dot(part.force, support.path);
      if (support.axes != 0)
        held[part.support] +=
            part.held_work + part.factor * dot(part.force, along(support.axes, support.path));
    }
    std::uint32_t counted = ~0u;
    for (const Contribution& part : block.contributions) {
      if ((part.displaced | part.driven) == 0 || part.support == counted) continue;
      counted = part.support;
      const BoundaryParticle& support = block.boundary_particles[part.support];
      work[part.load] += support.reaction_work + support.reaction_now - held[part.support];
    }
  }
  const double acceleration = norm(model.loads.acceleration);
  // Body accelerations share the work of the potential in proportion to their part of the whole.
  if (acceleration > 0)
    for (std::size_t l = 0; l < model.loads.size(); ++l)
      work[l] += potential * dot(model.loads[l].acceleration, model.loads.acceleration) /
                 (acceleration * acceleration);
  return work;
}

double gross_work(const BlockSet& blocks, double potential, double step) {
  double sum = std::abs(potential);
  const Vec3 gained = step * blocks.model().loads.acceleration;
  for (const Block& block : blocks) {
    for (const Contribution& part : block.contributions)
      sum += std::abs(part.work +
                      part.factor * dot(part.force, block.boundary_particles[part.support].path));
    for (const BoundaryParticle& support : block.boundary_particles)
      sum += std::abs(support.reaction_work + support.reaction_now) +
             (support.axes != 0 ? 0.5 * support.mass * dot(gained, gained) : 0);
  }
  return sum;
}

std::vector<Vec3> force_by_load(const BlockSet& blocks) {
  std::vector<Vec3> forces(blocks.model().loads.size());
  for (const Block& block : blocks)
    for (const Contribution& part : block.contributions) {
      const double* sum = block.boundary_particles[part.support].sum;
      const Vec3 force = Vec3{sum[0], sum[1], sum[2]} + block.held_force[part.support];
      forces[part.load] = forces[part.load] + along(part.displaced | part.driven, force);
    }
  return forces;
}

}  // namespace hyperlattice
