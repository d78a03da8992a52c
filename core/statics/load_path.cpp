// The path from the loads of a stage's start to those of its end, a straight line: forces and
// prescribed displacements change in proportion to a share from 0 to 1. If the state at the start
// needs further forces to be at rest, these act as holding forces and decrease in the same
// proportion.
#include <model/blame.hpp>
#include <statics/statics.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace hyperlattice {

void Statics::find_loaded() {
  const std::int64_t places = problem_.grid.places;
  for (std::size_t l = 0; l < model_.loads.size(); ++l)
    for (const LoadedParticle& loaded : model_.loads[l].particles) {
      const std::int64_t place = place_of(loaded.particle);
      if (!(loaded.force == Vec3{})) loaded_.push_back({place, l, loaded.force});
      for (int c = 0; c < 3; ++c) {
        const bool displaced = (loaded.displaced >> c & 1u) != 0;
        if (!displaced && (loaded.driven >> c & 1u) == 0) continue;
        prescribed_.push_back(
            {place, c, l, displaced, displaced ? loaded.displacement[c] : loaded.velocity[c]});
        free_[static_cast<std::size_t>(place)] =
            static_cast<std::uint8_t>(free_[static_cast<std::size_t>(place)] & ~(1u << c));
      }
    }
  if (problem_.grid.inertia)
    for (const Load& load : model_.loads) {
      Watching& watching = watching_.emplace_back();
      for (const WatchedParticle& watched : load.watched)
        watching.places.push_back(place_of(watched.particle));
      for (std::vector<Vec3>* values : {&watching.moved, &watching.velocity, &watching.answers})
        values->resize(load.watched.size());
    }
  if (model_.loads.acceleration == Vec3{} && !problem_.grid.inertia) return;
  mass_.assign(static_cast<std::size_t>(places), 0);
  for_runs([&](std::int64_t place, Particle particle, std::uint64_t count) {
    for (std::uint64_t n = 0; n < count; ++n)
      mass_[static_cast<std::size_t>(place) + n] = model_.mass(particle + n);
  });
}

void Statics::make_loads() {
  const bool fresh = simulation_.steps() == 0;  // no load acted before the run
  gravity_start_ = fresh ? 0 : 1;
  const std::int64_t places = problem_.grid.places;
  std::vector<double> ways;  // of each load that drives particles
  for (std::size_t l = 0; l < model_.loads.size(); ++l) {
    const Load& load = model_.loads[l];
    factor_start_.push_back(fresh ? 0 : load.after(start_));
    factor_end_.push_back(load.after(end_));
    const bool drives =
        std::any_of(load.particles.begin(), load.particles.end(),
                    [](const LoadedParticle& loaded) { return loaded.driven != 0; });
    const double way = drives ? load.integral(start_, end_) : 0;
    for (const auto& [factor, time] :
         {std::pair{factor_start_.back(), start_}, {factor_end_.back(), end_}})
      if (!std::isfinite(factor))
        blame_load(model_, l,
                   fmt::format("its factor at t = {:.6g} s is {}: no finite number", time, factor));
    if (!std::isfinite(way))
      blame_load(
          model_, l,
          fmt::format(
              "the way that it drives particles from {:.6g} s to {:.6g} s is no finite number",
              start_, end_));
    ways.push_back(way);
  }
  std::map<std::int64_t, Held> held;
  for (const Prescribed& axis : prescribed_) {
    Held& hold = held.try_emplace(axis.place, Held{axis.place, 0, {}, {}}).first->second;
    const int c = axis.component;
    hold.axes |= 1u << c;
    hold.from[c] = state_[static_cast<std::size_t>(c * places + axis.place)];
    hold.to[c] = axis.displaced ? factor_end_[axis.load] * axis.amplitude
                                : hold.from[c] + ways[axis.load] * axis.amplitude;
  }
  for (const auto& [place, hold] : held) held_.push_back(hold);

  find_preload();

  holding_.assign(problem_.grid.numbers(), 0);
  Values external(holding_.size());
  add_loads(0, external.data());
  for_runs([&](std::int64_t first, Particle, std::uint64_t count) {
    for (std::int64_t p = first; p < first + static_cast<std::int64_t>(count); ++p)
      for (int c = 0; c < problem_.grid.components; ++c) {
        const auto n = static_cast<std::size_t>(c * places + p);
        if ((free_[static_cast<std::size_t>(p)] >> c & 1u) != 0)
          holding_[n] = -force_[n] - external[n];
      }
  });
  add_loads(0, external.data());
  force_scale(force_.data(), external.data());
}

/// Finds the loads of the start over their change in the stage, for loads in one proportion; of
/// prescribed displacements if some change, else of forces.
void Statics::find_preload() {
  double along = 0, square = 0;
  const auto add = [&](double from, double to) {
    along += from * (to - from);
    square += (to - from) * (to - from);
  };
  for (const Held& held : held_)
    for (int c = 0; c < 3; ++c)
      if ((held.axes >> c & 1u) != 0) add(held.from[c], held.to[c]);
  if (square == 0)
    for (std::size_t l = 0; l < factor_end_.size(); ++l) add(factor_start_[l], factor_end_[l]);
  if (square == 0) add(gravity_start_, 1);
  preload_ = square > 0 ? std::max(0.0, along / square) : 0;
}

std::vector<double> Statics::factors(double share) const {
  std::vector<double> all;
  for (std::size_t l = 0; l < factor_end_.size(); ++l)
    all.push_back((1 - share) * factor_start_[l] + share * factor_end_[l]);
  return all;
}

void Statics::add_loads(double share, double* force) const {
  const std::int64_t places = problem_.grid.places;
  for (std::size_t n = 0; n < holding_.size(); ++n) force[n] = (1 - share) * holding_[n];
  const std::vector<double> factor = factors(share);
  for (const Loaded& loaded : loaded_)
    for (int c = 0; c < 3; ++c)
      force[c * places + loaded.place] += factor[loaded.load] * loaded.force[c];
  const double gravity = (1 - share) * gravity_start_ + share;
  for (int c = 0; c < 3 && !mass_.empty(); ++c)
    for (std::size_t p = 0; p < mass_.size(); ++p)
      force[static_cast<std::size_t>(c * places) + p] +=
          gravity * mass_[p] * model_.loads.acceleration[c];
}

void Statics::prescribe(double share, double* u) const {
  for (const Held& held : held_)
    for (int c = 0; c < 3; ++c)
      if ((held.axes >> c & 1u) != 0)
        u[c * problem_.grid.places + held.place] = (1 - share) * held.from[c] + share * held.to[c];
}

double Statics::force_scale(const double* internal, const double* external) {
  // Relative to the largest scale so far. Loads that end at zero leave only round-off of it.
  constexpr double share = 1e-6;
  const std::int64_t places = problem_.grid.places;
  const auto size = [](double x, double y, double z) {
    return x == 0 && y == 0 && z == 0 ? 0 : std::hypot(x, y, z);
  };  // squares may underflow
  double held = 0, loaded = 0;
  std::uint64_t number = 0;
  for (const Held& hold : held_) {
    double force[3] = {};
    for (int c = 0; c < 3; ++c)
      if ((hold.axes >> c & 1u) != 0)
        force[c] = internal[c * places + hold.place] + external[c * places + hold.place];
    held += size(force[0], force[1], force[2]) / static_cast<double>(held_.size());
  }
  for_runs([&](std::int64_t first, Particle, std::uint64_t count) {
    for (std::int64_t p = first; p < first + static_cast<std::int64_t>(count); ++p) {
      const double force = size(external[p], external[places + p], external[2 * places + p]);
      if (force == 0) continue;
      ++number;
      loaded += (force - loaded) / static_cast<double>(number);
    }
  });
  const double mean = std::max(held, loaded);
  if (std::isfinite(mean)) largest_scale_ = std::max(largest_scale_, mean);
  return std::max(mean, share * largest_scale_);
}

}  // namespace hyperlattice
