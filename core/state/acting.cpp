// Loads at the present time: the mean of their factors over the interval in which forces act, their
// answers to the motion, and the velocities of the particles that they move.
#include <model/blame.hpp>
#include <state/parts.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

namespace {

bool is_finite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Returns whether the guard would let this motion pass. In a body that blows up, answers of loads
/// overflow too, but the loads are not to blame.
bool is_sound(const WatchedMotion& seen, double step, double spacing) {
  constexpr double spacings = 100;  // in a step
  return std::all_of(seen.displacement.begin(), seen.displacement.end(), is_finite) &&
         std::all_of(seen.velocity.begin(), seen.velocity.end(),
                     [&](Vec3 v) { return norm(v) * step <= spacings * spacing; });
}

}  // namespace

/// Sets the factors of all loads. watch() fills in the motion that they watch.
void Simulation::Parts::prepare_loads(const Sweep& sweep) {
  for (std::size_t l = 0; l < acting.size(); ++l) {
    Acting& now = acting[l];
    const Load& load = model.loads[l];
    const double reach = sweep.step > 0 ? sweep.step : -last_step;
    if (time_held) {
      now.mean = now.next = now.mean_of_step = load.after(time);
      now.now = {now.mean, 0};
    } else {
      now.mean = load.mean(time - sweep.before, time + sweep.after);
      if (now.moves && sweep.step > 0) {
        now.next = load.factor(time + sweep.step);
        now.mean_of_step = load.mean(time, time + sweep.step);
      }
      if (now.moves && reach != 0 && (sweep.measured > 0 || last_step == 0))
        now.now = load.limit(time, reach);
    }
    now.motion = {time, now.mean, now.displacement, now.velocity};
  }
}

/// Copies the motion of the block's watched particles to the loads.
void Simulation::Parts::watch(const Block& block) {
  for (const Block::Watched& seen : block.watched) {
    const auto of = [&](const Numbers* field) {
      return Vec3{field[0][seen.index], field[1][seen.index], field[2][seen.index]};
    };
    acting[seen.load].displacement[seen.number] = of(block.displacement);
    acting[seen.load].velocity[seen.number] = of(block.velocity);
  }
}

/// Lets loads prepare their answers, after watch() of all blocks.
void Simulation::Parts::prepare_answers() {
  for (std::size_t l = 0; l < acting.size(); ++l)
    if (model.loads[l].prepares()) model.loads[l].prepare(acting[l].motion);
}

/// Sets the external forces. Their components along prescribed axes move nothing and are kept
/// apart: in the energy balance they would cancel except for round-off.
void Simulation::Parts::apply_forces(Block& block) const {
  block.bad_answer = no_load;
  for (std::size_t s = 0; s < block.boundary_particles.size(); ++s)
    block.boundary_particles[s].force = block.held_force[s] = {};
  for (Contribution& part : block.contributions) {
    const Acting& load = acting[part.load];
    part.factor = load.mean;
    if (part.watched != not_watched) {
      part.factor = 1;
      part.force = model.loads[part.load].answer(load.motion, part.watched);
      if (!is_finite(part.force) && block.bad_answer == no_load) block.bad_answer = part.load;
    }
    BoundaryParticle& support = block.boundary_particles[part.support];
    const Vec3 force = part.factor * part.force;
    if (support.axes == 0) {
      support.force = support.force + force;
      continue;
    }
    for (int c = 0; c < 3; ++c) {
      Vec3& sum = (support.axes >> c & 1u) != 0 ? block.held_force[part.support] : support.force;
      set_component(sum, c, component(sum, c) + component(force, c));
    }
  }
}

/// Returns the velocity, m/s, along an axis that the load prescribes. A prescribed displacement is
/// met at the end of each step; the path of a prescribed velocity is exact. While time is held,
/// both have their displacement at that time as goal.
double Simulation::Parts::prescribed_velocity(const Block& block, const Contribution& part,
                                              int axis, const Sweep& sweep) const {
  const Acting& load = acting[part.load];
  const std::uint64_t index = block.boundary_particles[part.support].index;
  const double displacement = component(part.displacement, axis),
               velocity = component(part.velocity, axis);
  const bool driven = (part.driven >> axis & 1u) != 0;
  if (driven && !time_held) return (sweep.step > 0 ? load.mean_of_step : load.now.value) * velocity;
  const double goal = driven ? component(part.goal, axis) : load.next * displacement;
  if (sweep.step > 0) return (goal - block.displacement[axis][index]) / sweep.step;
  return driven ? 0 : load.now.slope * displacement;
}

void Simulation::Parts::prepare_supports(Block& block, const Sweep& sweep) const {
  apply_forces(block);
  for (const Contribution& part : block.contributions) {
    if ((part.displaced | part.driven) == 0) continue;
    BoundaryParticle& support = block.boundary_particles[part.support];
    for (int c = 0; c < 3; ++c) {
      if (((part.displaced | part.driven) >> c & 1u) == 0) continue;
      double velocity = prescribed_velocity(block, part, c, sweep);
      // The velocity after a kick of that duration with the same acceleration.
      if (sweep.measured > 0) {
        const double now = block.velocity[c][support.index];
        velocity = now + 2 * sweep.measured / (sweep.before + sweep.after) * (velocity - now);
      }
      set_component(support.velocity, c, velocity);
    }
  }
}

/// Throws RunError if a load factor is not a number, at the present time or in the sweep.
void Simulation::Parts::check_factors() const {
  for (std::size_t l = 0; l < acting.size(); ++l) {
    const Acting& load = acting[l];
    const double now = model.loads[l].factor(time);
    if (!std::isfinite(now))
      blame_load(model, l,
                 fmt::format("its factor at t = {:.6g} s, step {}, is {}: no finite number", time,
                             steps, now));
    if (std::isfinite(load.mean + load.next + load.mean_of_step + load.now.value + load.now.slope))
      continue;
    blame_load(model, l,
               fmt::format("its factor is no finite number within a step of t = {:.6g} s, step {}",
                           time, steps));
  }
}

/// Throws RunError if a load's answer to a sound motion is not finite.
void Simulation::Parts::check_answers() const {
  for (const Block& block : blocks) {
    if (block.bad_answer == no_load) continue;
    if (is_sound(acting[block.bad_answer].motion, last_step, model.body.grid.spacing))
      blame_load(
          model, block.bad_answer,
          fmt::format("its answer at t = {:.6g} s, step {}, to a finite motion is no finite force",
                      time, steps));
  }
}

}  // namespace hyperlattice
