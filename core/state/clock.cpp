#include <state/clock.hpp>

namespace hyperlattice {

void Clock::set(double time) {
  time_ = time;
  round_off_ = 0;
}

void Clock::hold(double time) {
  held_ = true;
  set(time);
}

void Clock::advance(double step) {
  if (!held_) {
    const double added = step - round_off_, sum = time_ + added;
    round_off_ = (sum - time_) - added;
    time_ = sum;
  }
  advanced_ = held_ ? 0 : step;
  last_step_ = step;
  ++steps_;
}

void Clock::jump(double time, double step) {
  set(time);
  advanced_ = step;  // 0: failure criteria know no times between the states of rest
  ++steps_;
}

void Clock::archive(Archive& archive) {
  archive(time_);
  archive(round_off_);
  archive(held_);
  archive(steps_);
  archive(last_step_);
  archive(advanced_);
}

}  // namespace hyperlattice
