// What loads do at the present instant: their factors, by the mean over the interval in which
// forces act, their answers to the motion, and the velocities of the particles that they move.
#include <model/blame.hpp>
#include <state/parts.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

namespace {

bool is_finite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Whether a motion is one that the guard lets pass: a body that blows up overflows the answers
/// too.
bool is_sound(const WatchedMotion& seen, double step, double spacing) {
  constexpr double spacings = 100;  // in a step
  return std::all_of(seen.displacement.begin(), seen.displacement.end(), is_finite) &&
         std::all_of(seen.velocity.begin(), seen.velocity.end(),
                     [&](Vec3 v) { return norm(v) * step <= spacings * spacing; });
}

}  // namespace

/// What loads watch is filled in by watch().
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

/// Shows the loads what the block's particles do.
void Simulation::Parts::watch(const Block& block) {
  for (const Block::Watched& seen : block.watched) {
    const auto of = [&](const Numbers* field) {
      return Vec3{field[0][seen.index], field[1][seen.index], field[2][seen.index]};
    };
    acting[seen.load].displacement[seen.number] = of(block.displacement);
    acting[seen.load].velocity[seen.number] = of(block.velocity);
  }
}

/// Once all that loads watch has been shown to them.
void Simulation::Parts::prepare_answers() {
  for (std::size_t l = 0; l < acting.size(); ++l)
    if (model.loads[l].prepares()) model.loads[l].prepare(acting[l].motion);
}

/// External forces. Along prescribed axes they move nothing, and are kept apart: there they would
/// cancel in the books but for round-off.
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

/// m/s, along an axis that the load prescribes. A displacement is met at the end of each step, a
/// velocity's path is exact. Where time is held both stand where they are at that time.
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
      if (sweep.measured > 0) {  // the end of a kick of that length with the same acceleration
        const double now = block.velocity[c][support.index];
        velocity = now + 2 * sweep.measured / (sweep.before + sweep.after) * (velocity - now);
      }
      set_component(support.velocity, c, velocity);
    }
  }
}

/// RunError if a factor is not a number, at the present instant or in what the sweep makes of it.
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

/// RunError if an answer to a sound motion is not finite.
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
