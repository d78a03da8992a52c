// The time of a run and the number of its steps.
#pragma once

#include <state/archive.hpp>

#include <cstdint>

namespace hyperlattice {

class Clock {
 public:
  double time() const { return time_; }  ///< s
  bool is_held() const { return held_; }
  std::uint64_t steps() const { return steps_; }
  /// Returns the length, s, of the last step; 0 if the next step starts from rest.
  double last_step() const { return last_step_; }
  /// Returns by how much the last step advanced the time, s.
  double advanced() const { return advanced_; }

  void set(double time);
  /// Holds the time at `time`, s. Steps do not advance it until its release.
  void hold(double time);
  void release() { held_ = false; }
  /// Counts a step of this length, s.
  void advance(double step);
  /// Counts a change from one state of rest to another, which ends at `time`, s; or an implicit
  /// step of the length `step`, s.
  void jump(double time, double step = 0);
  /// Says that criteria have reviewed the present time.
  void review() { advanced_ = 0; }
  /// Lets the next step start from rest.
  void rest() { last_step_ = 0; }

  void archive(Archive& archive);

 private:
  double time_ = 0, round_off_ = 0;  // s, the two numbers of a compensated sum
  bool held_ = false;
  std::uint64_t steps_ = 0;
  double last_step_ = 0, advanced_ = 0;  // s
};

}  // namespace hyperlattice
