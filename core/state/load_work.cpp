#include <state/load_work.hpp>

#include <cmath>

namespace hyperlattice {
namespace {

/// Returns the vector with its components along all other axes set to zero.
Vec3 along(Axes axes, Vec3 v) {
  return {(axes & 1u) != 0 ? v.x : 0, (axes & 2u) != 0 ? v.y : 0, (axes & 4u) != 0 ? v.z : 0};
}

bool prescribes(const Contribution& part, int axis) {
  return ((part.displaced | part.driven) >> axis & 1u) != 0;
}

/// Returns the work of the reactions of a load on a particle along the support's path, J. `speeds`:
/// velocities after a kick of this duration, s.
template <class Speeds>
double reaction_work(const Block& block, const Contribution& part, const Speeds& speeds,
                     double kick) {
  double work = 0;
  for (int c = 0; c < 3; ++c)
    if (prescribes(part, c))
      work += reaction(block, part, c, speeds(c), kick) *
              block.boundary_particles[part.support].path[c];
  return work;
}

}  // namespace

double reaction(const Block& block, const Contribution& part, int axis, double speed, double kick) {
  const BoundaryParticle& support = block.boundary_particles[part.support];
  const double acceleration = acceleration_in(kick, support.speed_before[axis], speed);
  return support.mass * acceleration - support.sum[axis] - block.held_force[part.support][axis];
}

void count_work(Block& block, double kick) {
  for (Contribution& part : block.contributions) {
    const BoundaryParticle& support = block.boundary_particles[part.support];
    part.work += part.factor * dot(part.force, support.path);
    part.reaction_work += reaction_work(
        block, part, [&](int c) { return block.velocity[c][support.index]; }, kick);
  }
}

void count_work(BlockSet& blocks, const EquilibriumUpdate& to) {
  const Model& model = blocks.model();
  const auto mean_force = [&](const Contribution& part) {
    return part.watched != not_watched && !to.answers.empty()
               ? to.answers[part.load][part.watched]
               : 0.5 * (to.factor_before[part.load] + to.factor[part.load]) * part.force;
  };
  const Vec3 gravity = 0.5 * (to.gravity_before + to.gravity) * model.loads.acceleration;
  for (Block& block : blocks) {
    std::vector<Vec3> pushed(block.boundary_particles.size());  // mean force of all loads, N
    for (const Contribution& part : block.contributions) pushed[part.support] += mean_force(part);
    for (Contribution& part : block.contributions) {
      BoundaryParticle& support = block.boundary_particles[part.support];
      for (int c = 0; c < 3; ++c) {
        const std::size_t n = 3 * part.particle + static_cast<std::size_t>(c);
        const double moved = to.xyz[n] - block.displacement[c][support.index];
        part.work += mean_force(part)[c] * moved;
        if (!prescribes(part, c)) continue;
        const double internal = 0.5 * (to.force[n] + to.force_before[n]);
        part.reaction_work -=
            (internal + support.mass * gravity[c] + pushed[part.support][c]) * moved;
        support.reaction_work -= internal * moved;
      }
    }
  }
}

std::vector<double> work_by_load(const BlockSet& blocks, double potential, double last_step) {
  const Model& model = blocks.model();
  std::vector<double> work(model.loads.size(), 0);
  for (const Block& block : blocks)
    for (const Contribution& part : block.contributions) {
      const BoundaryParticle& support = block.boundary_particles[part.support];
      work[part.load] += part.work + part.factor * dot(part.force, support.path) +
                         part.reaction_work +
                         reaction_work(
                             block, part, [&](int c) { return support.velocity[c]; }, last_step);
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
  // Two sums, each in the order of the particles for any number of blocks.
  double of_forces = 0, of_reactions = 0;
  const Vec3 gained = step * blocks.model().loads.acceleration;
  for (const Block& block : blocks) {
    for (const Contribution& part : block.contributions)
      of_forces += std::abs(
          part.work + part.factor * dot(part.force, block.boundary_particles[part.support].path));
    for (const BoundaryParticle& support : block.boundary_particles)
      of_reactions += std::abs(support.reaction_work + support.reaction_now) +
                      (support.axes != 0 ? 0.5 * support.mass * dot(gained, gained) : 0);
  }
  return std::abs(potential) + of_forces + of_reactions;
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
