// The times at which an output is due.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace hyperlattice {

/// Instants at a regular interval. An output belongs to the step nearest to its instant.
class Schedule {
 public:
  Schedule() = default;
  /// Due at `start`, s, if `first`, and then every `every` seconds; 0: never again.
  Schedule(double start, double every, bool first)
      : start_(start), every_(every), count_(first ? 0 : 1) {}

  /// Returns whether an instant has come for a body at `time` with steps of `time_step`, s. Returns
  /// true once for each instant, and where time has fallen by an interval: along a snap-back the
  /// loads fall, and the time at which they would act falls with them.
  bool due(double time, double time_step) {
    if (count_ > 0 && !(every_ > 0)) return false;
    const double reached = time + 0.5 * time_step - start_;
    if (reached < static_cast<double>(count_) * every_ && time > shown_ - every_) return false;
    shown_ = time;
    count_ = every_ > 0 ? static_cast<std::uint64_t>(std::max(0.0, reached) / every_) + 1 : 1;
    return true;
  }

 private:
  double start_ = 0, every_ = 0;
  double shown_ = -std::numeric_limits<double>::infinity();  // s
  std::uint64_t count_ = 0;
};

}  // namespace hyperlattice
