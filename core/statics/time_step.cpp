// Implicit steps in time. With the mean displacement w = u + g (u' - u) at the part g of a step of
// the length h, and with mean loads F,
//   m (w - u - g h v) / (g h)^2 = f + F,   u' = u + (w - u) / g,   v' = v + ((u' - u) / h - v) / g.
// The force f of a spring points along its ends at w and has the size of its mean elongation over
// its mean length. For a linear spring then f.(u' - u) = -(E' - E) at g = 1/2: energy, momentum and
// angular momentum stay, however far the body turns (LaBudde and Greenspan, Numer. Math. 26 (1976)
// 1-16). See docs/theory/implicit.md.
#include <host/plugin_call.hpp>
#include <model/blame.hpp>
#include <statics/statics.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace hyperlattice {

void Statics::time_row(SpringRow& row) const {
  if (!moves()) return;
  row.forward = step_->of.forward;
  row.time_step = step_->of.forward * step_->of.length;
}

/// Lets a row of springs start at a place and end `step` places on, in the motion `u`; in a step in
/// time also in the state before it.
void Statics::place_row(const double* u, std::int64_t place, std::int64_t step,
                        SpringRow& row) const {
  const StaticGrid& grid = problem_.grid;
  for (int c = 0; c < grid.components; ++c) {
    row.here[c] = u + c * grid.places + place;
    row.there[c] = row.here[c] + step;
    if (!moves()) continue;
    row.here_before[c] = state_.data() + c * grid.places + place;
    row.there_before[c] = row.here_before[c] + step;
  }
  time_row(row);
}

/// Finds the velocities at the time of the present state, before the first step.
void Statics::read_velocity(double time_step) {
  const auto places = static_cast<std::size_t>(problem_.grid.places);
  const double last = simulation_.last_step();
  std::vector<double> xyz, heights;
  const auto read = [&] {
    simulation_.velocities(xyz);
    simulation_.height_rates(heights);
    for_runs([&](std::int64_t first, Particle particle, std::uint64_t count) {
      for (std::uint64_t n = 0; n < count; ++n) {
        const std::size_t place = static_cast<std::size_t>(first) + n;
        for (std::size_t c = 0; c < 3; ++c)
          velocity_[c * places + place] = xyz[3 * (particle + n) + c];
        if (!heights.empty()) velocity_[3 * places + place] = heights[particle + n];
      }
    });
  };
  velocity_.assign(problem_.grid.numbers(), 0);
  read();
  if (last > 0) {  // they are those of half a step before
    Values force = force_;
    const double now = simulation_.time();
    std::vector<double> factors;
    for (const Load& load : model_.loads) factors.push_back(load.mean(now - last / 2, now));
    for (const Loaded& loaded : loaded_)
      for (int c = 0; c < 3; ++c)
        force[static_cast<std::size_t>(c) * places + static_cast<std::size_t>(loaded.place)] +=
            factors[loaded.load] * loaded.force[c];
    add_answers(factors, {now, state_.data(), [&](std::size_t n) { return velocity_[n]; }},
                force.data());
    for_numbers([&](std::size_t n, std::size_t place, int c, bool free) {
      if (!free) return;
      velocity_[n] +=
          0.5 * last * (force[n] / mass_[place] + (c < 3 ? model_.loads.acceleration[c] : 0));
    });
  }
  simulation_.begin_implicit_steps(
      time_step, of_particles(velocity_.data(), 0, 3),
      problem_.grid.components == 4 ? of_particles(velocity_.data(), 3, 1) : std::vector<double>());
  read();
}

void Statics::begin_step(const TimeStep& step) {
  step_.reset();
  if (velocity_.empty()) read_velocity(step.length);
  const double start = simulation_.time(), end = start + step.length;
  Step now;
  now.of = step;
  for (std::size_t l = 0; l < model_.loads.size(); ++l) {
    const double mean = model_.loads[l].integral(start, end) / step.length;
    if (!std::isfinite(mean))
      blame_load(model_, l,
                 fmt::format("the mean of its factor from {:.6g} s to {:.6g} s is no finite number",
                             start, end));
    now.factor.push_back(mean);
  }
  for (const Prescribed& axis : prescribed_) {
    const double from =
        state_[static_cast<std::size_t>(axis.component * problem_.grid.places + axis.place)];
    now.held.push_back(axis.displaced
                           ? model_.loads[axis.load].factor(end) * axis.amplitude
                           : from + now.factor[axis.load] * step.length * axis.amplitude);
    if (!std::isfinite(now.held.back()))
      blame_load(model_, axis.load,
                 fmt::format("its factor at t = {:.6g} s is no finite number", end));
  }
  now.anchor.resize(state_.size());
  for (std::size_t n = 0; n < state_.size(); ++n)
    now.anchor[n] = state_[n] + step.forward * step.length * velocity_[n];
  step_ = std::move(now);
}

void Statics::add_inertia(const double* mean, double* force) const {
  const double factor = step_->inertia();
  const auto places = static_cast<std::size_t>(problem_.grid.places);
  mean_force_ = 0;
  for (std::size_t p = 0; p < places; ++p)
    mean_force_ += norm({force[p], force[places + p], force[2 * places + p]}) /
                   static_cast<double>(model_.body.particles);
  for_numbers([&](std::size_t n, std::size_t place, int, bool free) {
    if (free) force[n] -= factor * mass_[place] * (mean[n] - step_->anchor[n]);
  });
}

/// Checks that a step has begun. begin_step() may have failed: its error waits until the solver
/// has returned (plugin_call.hpp).
void Statics::expect_step() const {
  if (!moves()) throw PluginMistake("it takes an implicit step that has not begun");
}

void Statics::add_step_loads(double* force) const {
  expect_step();
  const std::int64_t places = problem_.grid.places;
  std::fill_n(force, problem_.grid.numbers(), 0.0);
  for (const Loaded& loaded : loaded_)
    for (int c = 0; c < 3; ++c)
      force[c * places + loaded.place] += step_->factor[loaded.load] * loaded.force[c];
  for (int c = 0; c < 3; ++c)
    if (const double acceleration = model_.loads.acceleration[c]; acceleration != 0)
      for (std::size_t p = 0; p < mass_.size(); ++p)
        force[static_cast<std::size_t>(c * places) + p] += mass_[p] * acceleration;
}

void Statics::prescribe_mean(double* mean) const {
  expect_step();
  for (std::size_t n = 0; n < prescribed_.size(); ++n) {
    const auto at = static_cast<std::size_t>(prescribed_[n].component * problem_.grid.places +
                                             prescribed_[n].place);
    mean[at] = step_->mean(state_[at], step_->held[n]);
  }
}

/// Returns the reference of out-of-balance forces: the mean force of springs, or of loads on the
/// particles that they load, and at least a thousandth of the force that would stop the body within
/// the step.
double Statics::motion_scale(const double* external) {
  constexpr double least = 1e-3, share = 1e-6;
  const auto places = static_cast<std::size_t>(problem_.grid.places);
  const double stop = 1 / (step_->of.forward * step_->of.length);
  double loads = 0, motion = 0;
  std::uint64_t loaded = 0;
  for_runs([&](std::int64_t first, Particle, std::uint64_t count) {
    for (std::size_t p = static_cast<std::size_t>(first);
         p < static_cast<std::size_t>(first) + count; ++p) {
      const auto of = [&](const double* field) {
        return Vec3{field[p], field[places + p], field[2 * places + p]};
      };
      const Vec3 load = of(external);
      motion += mass_[p] * stop * norm(of(velocity_.data()));
      if (load == Vec3{}) continue;
      ++loaded;
      loads += norm(load);
    }
  });
  const double mean =
      std::max({mean_force_, least * motion / static_cast<double>(model_.body.particles),
                loaded > 0 ? loads / static_cast<double>(loaded) : 0});
  if (std::isfinite(mean)) largest_scale_ = std::max(largest_scale_, mean);
  return std::max(mean, share * largest_scale_);
}

/// Returns the energy, J, that the method takes: (g - 1/2) times that of the changes of velocities
/// and of forces; and that of jumps of prescribed velocities.
double Statics::numerical_dissipation(const Values& after, const Values& speed) {
  const double part = step_->of.forward - 0.5;
  const bool damps = part > 0;
  Values force_after(damps ? force_.size() : 0);
  if (damps) {
    auto step = std::exchange(step_, std::nullopt);
    respond(after.data(), force_after.data(), nullptr);
    step_ = std::move(step);
  }
  double dissipated = 0;
  for_numbers([&](std::size_t n, std::size_t place, int, bool free) {
    const double gained = speed[n] - velocity_[n];
    dissipated += (free ? part : 0.5) * mass_[place] * gained * gained;
    if (damps) dissipated -= part * (force_after[n] - force_[n]) * (after[n] - state_[n]);
  });
  if (damps) force_ = std::move(force_after);
  return dissipated;
}

/// Finds the state at the end of the step: displacements, m, velocities, m/s, and the update that
/// has both.
EquilibriumUpdate Statics::end_of_step(const double* mean, Values& after, Values& speed) const {
  expect_step();
  const double length = step_->of.length;
  after.resize(state_.size());
  speed.resize(state_.size());
  for (std::size_t n = 0; n < state_.size(); ++n) {
    after[n] = end_of(n, mean);
    speed[n] = velocity_[n] + ((after[n] - state_[n]) / length - velocity_[n]) / step_->of.forward;
  }
  for (std::size_t n = 0; n < prescribed_.size(); ++n) {
    const auto at = static_cast<std::size_t>(prescribed_[n].component * problem_.grid.places +
                                             prescribed_[n].place);
    after[at] = step_->held[n];
    speed[at] = (after[at] - state_[at]) / length;
  }
  EquilibriumUpdate to;
  to.time = simulation_.time() + length;
  to.time_step = length;
  to.forward = step_->of.forward;
  to.xyz = of_particles(after.data(), 0, 3);
  to.velocity = of_particles(speed.data(), 0, 3);
  if (problem_.grid.components == 4) {
    to.heights = of_particles(after.data(), 3, 1);
    to.height_rate = of_particles(speed.data(), 3, 1);
  }
  return to;
}

void Statics::accept_step(const double* mean) {
  const auto places = static_cast<std::size_t>(problem_.grid.places);
  Values force(state_.size()), after, speed;
  EquilibriumUpdate to = end_of_step(mean, after, speed);
  respond(mean, force.data(), nullptr);
  for (const Prescribed& axis : prescribed_) {
    const auto place = static_cast<std::size_t>(axis.place),
               at = static_cast<std::size_t>(axis.component) * places + place;
    force[at] -= mass_[place] * (speed[at] - velocity_[at]) / to.time_step;
  }
  for (const Watching& watching : watching_) {
    to.answers.push_back(watching.answers);
    for (std::size_t n = 0; n < watching.places.size(); ++n)
      for (int c = 0; c < 3; ++c)
        force[static_cast<std::size_t>(c) * places +
              static_cast<std::size_t>(watching.places[n])] -= watching.answers[n][c];
  }
  for (std::size_t l = 0; l < watching_.size(); ++l)
    if (const std::span<double> memory = simulation_.load_memory(l); !memory.empty())
      model_.loads[l].update(watched_motion(l, step_->factor[l], mean_motion(mean)), memory);
  to.force = to.force_before = of_particles(force.data(), 0, 3);
  to.factor = to.factor_before = step_->factor;
  to.dissipated = numerical_dissipation(after, speed);
  apply(to);
  state_ = std::move(after);
  problem_.state = state_.data();
  velocity_ = std::move(speed);
  step_.reset();
  if (problem_.broke > 0) respond(state_.data(), force_.data(), nullptr);
}

std::vector<double> Statics::motion_memory() const {
  std::vector<double> all;
  if (velocity_.empty()) return all;
  all.push_back(largest_scale_);
  for (const Values* field : {&state_, &velocity_, &force_})
    all.insert(all.end(), field->begin(), field->end());
  return all;
}

void Statics::recall_motion(std::span<const double> memory) {
  const std::size_t numbers = problem_.grid.numbers();
  if (memory.size() != 1 + 3 * numbers)
    throw std::runtime_error("the checkpoint is of another body");
  largest_scale_ = memory.front();
  auto from = memory.begin() + 1;
  for (Values* field : {&state_, &velocity_, &force_}) {
    field->assign(from, from + static_cast<std::ptrdiff_t>(numbers));
    from += static_cast<std::ptrdiff_t>(numbers);
  }
  problem_.state = state_.data();
}

}  // namespace hyperlattice
