#include <run/checkpoints.hpp>

#include <model/model.hpp>

#include <algorithm>

namespace hyperlattice {

double Checkpoints::first_interval(const Plan& plan, double seconds_between) {
  constexpr double shortest = 10;           // s
  constexpr double bytes_per_second = 1e8;  // of a slow disk
  const double bytes = plan.bytes_per_particle * static_cast<double>(plan.model->body.particles);
  return std::min(seconds_between, std::max(shortest, share * bytes / bytes_per_second));
}

void Checkpoints::save(std::uint64_t steps, double time) {
  drain_();
  const auto began = saved_ = std::chrono::steady_clock::now();
  if (!ranks_.is_first()) {
    if (steps != plan_.first_step()) pass_();
    return;
  }
  stopwatch_.lap();  // a run that continues from here counts this part too
  stopwatch_.output([&] {
    CheckpointHead head = checkpoint_head(plan_, steps == plan_.first_step());
    head.step = steps;
    head.time = time;
    if (!head.at_start)
      // The data that the checkpoint relies on must be on the disk before it.
      head.tables = folder_.sync();
    write_checkpoint(folder_.directory(), head, state_);
  });
  saved_ = std::chrono::steady_clock::now();
  if (steps != plan_.first_step())
    interval_ = std::min(seconds_between_, std::max(2 * interval_, share * seconds_since(began)));
}

void Checkpoints::save_if_due(std::uint64_t steps, double time, std::uint64_t stage_steps,
                              double sweeps_per_step) {
  constexpr double between = 16;  // sweeps; a clock costs about as much as a hundred particles
  const auto every = static_cast<std::uint64_t>(std::max(1.0, between / sweeps_per_step));
  if (!(seconds_between_ > 0) || stage_steps == 0 || stage_steps % every != 0) return;
  // The clock of one rank decides for all.
  if (ranks_.is_first() && seconds_since(saved_) >= interval_) ranks_.wish(Wish::save);
  if (!ranks_.agreed(Wish::save)) return;
  ranks_.done(Wish::save);
  if (is_sound_()) save(steps, time);
}

}  // namespace hyperlattice
