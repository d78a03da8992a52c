// The elongation below which a condition of a spring cannot hold, found by interval arithmetic.
#pragma once

#include <quantities/interval.hpp>

#include <hyperlattice/failure.hpp>

namespace hyperlattice::spring_condition {

/// The inputs of a condition, in their order.
enum Input : std::size_t {
  elongation,
  strain,
  rate,
  strain_rate,
  force,
  time,
  rest_length,
  stiffness,
  spacing,
  input_count
};

/// Finds alarms of a condition.
class Alarm {
 public:
  explicit Alarm(const Compiled& condition);

  /// Returns the largest elongation, m, up to which the condition is certainly false, whatever the
  /// rate and the time; -rest_length if there is none, so that each spring is asked in each step.
  double of(const SpringFacts& spring) const;

 private:
  /// Returns the largest x up to which the condition is certainly false, if the inputs are those of
  /// spring(x); `lowest` if there is none.
  template <class SpringAt>
  double search(double lowest, const SpringAt& spring) const;
  double of_elongation(const SpringFacts& spring) const;

  const Compiled& condition_;
  std::uint64_t number_;       ///< of this object, different from those of all others
  bool is_of_strain_ = false;  ///< depends on no other measure of the spring
  double strain_ = 0;          ///< alarm as a strain
  double margin_ = 0;          ///< relative error of the functions and of the scaling
};

}  // namespace hyperlattice::spring_condition
