#include <model/blame.hpp>
#include <state/acting_loads.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
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

ActingLoads::ActingLoads(BlockSet& blocks, const Clock& clock)
    : blocks_(blocks), model_(blocks.model()), clock_(clock), acting_(model_.loads.size()) {
  for (std::size_t l = 0; l < acting_.size(); ++l) {
    const Load& load = model_.loads[l];
    acting_[l].displacement.resize(load.watched.size());
    acting_[l].velocity.resize(load.watched.size());
    acting_[l].memory.resize(load.memory);
    for (const LoadedParticle& loaded : load.particles)
      acting_[l].moves |= (loaded.displaced | loaded.driven) != 0;
  }
  watched_.resize(static_cast<std::size_t>(blocks_.ranks().count()));
  for (const Block& block : blocks_) {
    std::vector<Block::Watched>& of_rank =
        watched_[static_cast<std::size_t>(blocks_.owner(block.number))];
    of_rank.insert(of_rank.end(), block.watched.begin(), block.watched.end());
  }
}

void ActingLoads::rest(std::vector<double> factors, double gravity) {
  rest_factors_ = std::move(factors);
  gravity_ = gravity;
}

void ActingLoads::archive(Archive& archive) {
  archive(rest_factors_);
  archive(gravity_);
  for (Acting& load : acting_)
    if (!load.memory.empty()) archive(std::span(load.memory));
}

void ActingLoads::prepare(const Sweep& sweep) {
  if (sweep.step > 0) leave_rest();
  const double time = clock_.time();
  for (std::size_t l = 0; l < acting_.size(); ++l) {
    Acting& now = acting_[l];
    const Load& load = model_.loads[l];
    const double reach = sweep.step > 0 ? sweep.step : -clock_.last_step();
    if (clock_.is_held()) {
      now.mean = now.next = now.mean_of_step = load.after(time);
      now.now = {now.mean, 0};
    } else {
      now.mean = load.mean(time - sweep.before, time + sweep.after);
      if (now.moves && sweep.step > 0) {
        now.next = load.factor(time + sweep.step);
        now.mean_of_step = load.mean(time, time + sweep.step);
      }
      if (now.moves && reach != 0 && (sweep.measured > 0 || clock_.last_step() == 0))
        now.now = load.limit(time, reach);
    }
    if (!rest_factors_.empty()) now.mean = rest_factors_[l];
    now.motion = {time, now.mean, now.displacement, now.velocity, now.memory};
  }
}

void ActingLoads::watch(const Block& block) {
  for (const Block::Watched& seen : block.watched) {
    const auto of = [&](const Numbers* field) {
      return Vec3{field[0][seen.index], field[1][seen.index], field[2][seen.index]};
    };
    acting_[seen.load].displacement[seen.number] = of(block.displacement);
    acting_[seen.load].velocity[seen.number] = of(block.velocity);
  }
}

void ActingLoads::share_watched() {
  Ranks& ranks = blocks_.ranks();
  const bool any = std::any_of(watched_.begin(), watched_.end(),
                               [](const auto& of_rank) { return !of_rank.empty(); });
  if (ranks.is_alone() || blocks_.is_whole() || !any) return;
  ranks.meet(Ranks::Meeting::loads);
  for (int rank = 0; rank < ranks.count(); ++rank) {
    const std::vector<Block::Watched>& seen = watched_[static_cast<std::size_t>(rank)];
    std::vector<std::array<Vec3, 2>> motion(seen.size());
    if (rank == ranks.rank())
      std::transform(seen.begin(), seen.end(), motion.begin(), [this](const Block::Watched& one) {
        return std::array{acting_[one.load].displacement[one.number],
                          acting_[one.load].velocity[one.number]};
      });
    ranks.spread(rank, std::as_writable_bytes(std::span(motion)));
    for (std::size_t n = 0; n < seen.size(); ++n) {
      acting_[seen[n].load].displacement[seen[n].number] = motion[n][0];
      acting_[seen[n].load].velocity[seen[n].number] = motion[n][1];
    }
  }
}

void ActingLoads::prepare_answers() {
  for (std::size_t l = 0; l < acting_.size(); ++l)
    if (model_.loads[l].prepares()) model_.loads[l].prepare(acting_[l].motion);
}

void ActingLoads::update_memory() {
  for (std::size_t l = 0; l < acting_.size(); ++l)
    if (Acting& now = acting_[l]; !now.memory.empty())
      model_.loads[l].update(now.motion, now.memory);
}

/// Sets the external forces. Their components along prescribed axes move nothing and are kept
/// apart: in the energy balance they would cancel except for round-off.
void ActingLoads::apply_forces(Block& block) const {
  block.bad_answer = no_load;
  for (std::size_t s = 0; s < block.boundary_particles.size(); ++s)
    block.boundary_particles[s].force = block.held_force[s] = {};
  for (Contribution& part : block.contributions) {
    const Acting& load = acting_[part.load];
    part.factor = load.mean;
    if (part.watched != not_watched) {
      part.factor = 1;
      part.force = model_.loads[part.load].answer(load.motion, part.watched);
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
      sum[c] = sum[c] + force[c];
    }
  }
}

/// Returns the velocity, m/s, along an axis that the load prescribes. A prescribed displacement is
/// met at the end of each step; the path of a prescribed velocity is exact. While time is held,
/// both have their displacement at that time as goal.
double ActingLoads::prescribed_velocity(const Block& block, const Contribution& part, int axis,
                                        const Sweep& sweep) const {
  const Acting& load = acting_[part.load];
  const std::uint64_t index = block.boundary_particles[part.support].index;
  const double displacement = part.displacement[axis], velocity = part.velocity[axis];
  const bool driven = (part.driven >> axis & 1u) != 0;
  if (driven && !clock_.is_held())
    return (sweep.step > 0 ? load.mean_of_step : load.now.value) * velocity;
  const double goal = driven ? part.goal[axis] : load.next * displacement;
  if (sweep.step > 0) return (goal - block.displacement[axis][index]) / sweep.step;
  return driven ? 0 : load.now.slope * displacement;
}

void ActingLoads::set_supports(Block& block, const Sweep& sweep) const {
  apply_forces(block);
  for (const Contribution& part : block.contributions) {
    if ((part.displaced | part.driven) == 0) continue;
    BoundaryParticle& support = block.boundary_particles[part.support];
    for (int c = 0; c < 3; ++c) {
      if (((part.displaced | part.driven) >> c & 1u) == 0) continue;
      // After a state of rest or an implicit step, velocities are those at the present time.
      const bool known = sweep.step == 0 && clock_.last_step() == 0;
      double velocity =
          known ? block.velocity[c][support.index] : prescribed_velocity(block, part, c, sweep);
      // The velocity after a kick of that duration with the same acceleration.
      if (sweep.measured > 0) {
        const double now = block.velocity[c][support.index];
        velocity = now + 2 * sweep.measured / (sweep.before + sweep.after) * (velocity - now);
      }
      support.velocity[c] = velocity;
    }
  }
}

bool ActingLoads::start_motion(double step) {
  const Sweep at_once{0, 0, 0, 0};
  prepare({0, step / 2, step, 0});  // takes limits from after the present time
  check_factors();
  bool changed = false;
  for (Block& block : blocks_)
    for (Contribution& part : block.contributions) {
      if ((part.displaced | part.driven) == 0) continue;
      BoundaryParticle& support = block.boundary_particles[part.support];
      for (int c = 0; c < 3; ++c) {
        if (((part.displaced | part.driven) >> c & 1u) == 0) continue;
        const double before = block.velocity[c][support.index],
                     now = prescribed_velocity(block, part, c, at_once);
        if (now == before) continue;
        block.velocity[c].set(support.index, now);
        const double gained = 0.5 * support.mass * (now * now - before * before);
        if (clock_.steps() == 0) {
          changed = changed || blocks_.is_mine(block);  // other ranks' blocks may be out of date
        } else {
          part.reaction_work += gained;
          support.reaction_work += gained;
        }
      }
    }
  return blocks_.ranks().meet(Ranks::Meeting::state, changed ? 1 : 0) > 0;
}

void ActingLoads::set_goals(double time) {
  for (Block& block : blocks_)
    for (Contribution& part : block.contributions) {
      if (part.driven == 0) continue;
      const double way = model_.loads[part.load].integral(clock_.time(), time);
      const std::uint64_t index = block.boundary_particles[part.support].index;
      for (int c = 0; c < 3; ++c)
        part.goal[c] = block.displacement[c][index] + way * part.velocity[c];
    }
}

void ActingLoads::check_factors() const {
  for (std::size_t l = 0; l < acting_.size(); ++l) {
    const Acting& load = acting_[l];
    const double now = model_.loads[l].factor(clock_.time());
    if (!std::isfinite(now))
      blame_load(model_, l,
                 fmt::format("its factor at t = {:.6g} s, step {}, is {}: no finite number",
                             clock_.time(), clock_.steps(), now));
    if (std::isfinite(load.mean + load.next + load.mean_of_step + load.now.value + load.now.slope))
      continue;
    blame_load(model_, l,
               fmt::format("its factor is no finite number within a step of t = {:.6g} s, step {}",
                           clock_.time(), clock_.steps()));
  }
}

void ActingLoads::check_answers() const {
  for (const Block& block : blocks_) {
    if (block.bad_answer == no_load) continue;
    if (is_sound(acting_[block.bad_answer].motion, clock_.last_step(), model_.body.grid.spacing))
      blame_load(
          model_, block.bad_answer,
          fmt::format("its answer at t = {:.6g} s, step {}, to a finite motion is no finite force",
                      clock_.time(), clock_.steps()));
  }
}

}  // namespace hyperlattice
