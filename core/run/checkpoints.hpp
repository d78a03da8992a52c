// The checkpoints that a run saves: at stops, before stages that are repeated as a whole, and at
// an interval.
#pragma once

#include <ranks/ranks.hpp>
#include <run/checkpoint.hpp>
#include <run/stopwatch.hpp>

namespace hyperlattice {

/// All members throw OutsideError or std::runtime_error if the disk refuses.
class Checkpoints {
 public:
  /// The first of `ranks` writes. `seconds_between`: of save_if_due(), at most; 0: it never saves.
  /// `is_sound`: whether the state has not gone wrong, so that save_if_due() may save it. `drain`
  /// waits until all frames are written, and prepares the state in every rank. `state` passes all
  /// that the run needs to an archive; meanwhile the other ranks call `pass`.
  Checkpoints(const Plan& plan, RunFolder& folder, Stopwatch& stopwatch, Ranks& ranks,
              double seconds_between, std::function<bool()> is_sound, std::function<void()> drain,
              std::function<void()> pass, Visit state)
      : plan_(plan),
        folder_(folder),
        stopwatch_(stopwatch),
        ranks_(ranks),
        seconds_between_(seconds_between),
        interval_(first_interval(plan, seconds_between)),
        is_sound_(std::move(is_sound)),
        drain_(std::move(drain)),
        pass_(std::move(pass)),
        state_(std::move(state)) {}

  /// Saves the state after this number of steps, at `time`, s; before the first step of the run
  /// nothing but the head.
  void save(std::uint64_t steps, double time);
  /// Saves the state if the last checkpoint is old and the state is sound. The first one is saved
  /// after ten seconds, and each interval is twice the one before until it is `seconds_between`: so
  /// a run that fails early leaves a state, too. Saving takes no more than about a fiftieth of the
  /// time. `stage_steps`: steps of the present stage; `sweeps_per_step`:
  /// SolverPlan::sweeps_per_step.
  void save_if_due(std::uint64_t steps, double time, std::uint64_t stage_steps,
                   double sweeps_per_step);

  /// Returns the seconds after which a run saves its first checkpoint.
  static double first_interval(const Plan& plan, double seconds_between);

 private:
  static constexpr double share = 50;  ///< times the seconds of saving: an interval at least

  const Plan& plan_;
  RunFolder& folder_;
  Stopwatch& stopwatch_;
  Ranks& ranks_;
  double seconds_between_, interval_;  // s
  std::function<bool()> is_sound_;
  std::function<void()> drain_, pass_;
  Visit state_;
  std::chrono::steady_clock::time_point saved_ = std::chrono::steady_clock::now();
};

}  // namespace hyperlattice
