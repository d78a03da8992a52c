// The answers of loads to the motion in an implicit step: contact, floors, forces that follow the
// body. Loads see the mean displacements and velocities of the step.
#include <model/blame.hpp>
#include <statics/statics.hpp>

#include <spdlog/fmt/fmt.h>

#include <cmath>

namespace hyperlattice {

Statics::Seen Statics::mean_motion(const double* mean) const {
  const double time = step_->of.forward * step_->of.length;
  return {simulation_.time() + time, mean,
          [=, this](std::size_t n) { return (mean[n] - state_[n]) / time; }};
}

/// Returns what a load sees of a motion.
WatchedMotion Statics::watched_motion(std::size_t load, double factor, const Seen& seen) const {
  Watching& watching = watching_[load];
  for (std::size_t n = 0; n < watching.places.size(); ++n)
    for (int c = 0; c < 3; ++c) {
      const auto at = static_cast<std::size_t>(c * problem_.grid.places + watching.places[n]);
      watching.moved[n][c] = seen.displacement[at];
      watching.velocity[n][c] = seen.velocity(at);
    }
  return {seen.time, factor, watching.moved, watching.velocity, simulation_.load_memory(load)};
}

/// Adds the answers of loads to a motion. `factors`: of each load.
void Statics::add_answers(const std::vector<double>& factors, const Seen& seen,
                          double* force) const {
  for (std::size_t l = 0; l < watching_.size(); ++l) {
    Watching& watching = watching_[l];
    const Load& load = model_.loads[l];
    if (watching.places.empty()) continue;
    const WatchedMotion motion = watched_motion(l, factors[l], seen);
    if (load.prepares()) load.prepare(motion);
    for (std::size_t n = 0; n < watching.places.size(); ++n) {
      const Vec3 answer = load.watched[n].answered ? load.answer(motion, n) : Vec3{};
      if (!std::isfinite(norm(answer)))
        blame_load(model_, l,
                   fmt::format("its answer at t = {:.6g} s is no finite force", motion.time));
      watching.answers[n] = answer;
      for (int c = 0; c < 3; ++c) force[c * problem_.grid.places + watching.places[n]] += answer[c];
    }
  }
}

}  // namespace hyperlattice
