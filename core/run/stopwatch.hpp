// The seconds that a run spends on solving and on output.
#pragma once

#include <state/archive.hpp>

#include <chrono>

namespace hyperlattice {

/// Returns the seconds since `start`.
double seconds_since(std::chrono::steady_clock::time_point start);

/// Measures the time of solvers and the time of outputs. The sums are part of a checkpoint, so that
/// a resumed run counts the time before it, too.
class Stopwatch {
 public:
  void archive(Archive& archive);

  /// Begins the time of the solvers.
  void start();
  /// Adds the time since start() or the last lap(), without outputs, to the time of the solvers.
  void lap();
  /// Calls `output` and adds its time to the time of the outputs.
  template <class Output>
  void output(Output&& output) {
    const auto begin = Clock::now();
    output();
    output_seconds_ += seconds_since(begin);
  }

  double solve_seconds() const { return solve_seconds_; }
  double output_seconds() const { return output_seconds_; }

 private:
  using Clock = std::chrono::steady_clock;

  double solve_seconds_ = 0, output_seconds_ = 0;
  Clock::time_point lap_start_;
  double output_at_lap_start_ = 0;  ///< output_seconds_ at that time
};

}  // namespace hyperlattice
