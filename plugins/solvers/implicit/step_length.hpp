// The length of implicit steps from an estimate of their error. With mean velocities V, the
// displacements of a step of the length h have the local error
//   h^3 / 12 |d3u/dt3|,   d3u/dt3 from the second difference of V over three steps,
// which is compared with the largest displacement so far, both as root mean squares.
#pragma once

#include <equilibrium/numerics.hpp>

#include <algorithm>
#include <span>
#include <vector>

namespace hyperlattice::implicit {

class StepLength {
 public:
  /// `first`: the first length, s; `longest`: no step is longer, s; `tolerance`: relative local
  /// error of a step, or 0 for steps that only change where the search fails.
  StepLength(double first, double longest, double tolerance)
      : length_(first), longest_(longest), tolerance_(tolerance) {}

  /// Returns the length of the next step, s, with `left` seconds to the end: never a small rest.
  double next(double left) const;
  /// Looks at a step of the length h that changed the displacements by `change` to `end`. Returns
  /// false if its error is too large and the step must be repeated with the next length.
  bool accept(double h, const equilibrium::Field& change, const equilibrium::Field& end);
  /// Halves the length after a search that failed. Returns false after the tenth failure in a row.
  bool shorten(double h);
  /// Sets the length of the next step, s: `length`, or `least` if that is longer. For steps in
  /// which springs break or damage grows.
  void cut(double length, double least) { length_ = std::max(length, least); }
  /// Adds all that a resumed run needs to `memory`, after a step.
  void remember(std::vector<double>& memory) const;
  /// Goes on with what remember() added.
  void recall(std::span<const double> memory);
  /// Returns the mean velocity of the last step, m/s; empty before the first.
  const equilibrium::Field& velocity() const { return velocity_; }

 private:
  double error(double h, const equilibrium::Field& velocity) const;

  double length_, longest_, tolerance_;
  int failures_ = 0;                               // of searches, in a row
  double largest_ = 0;                             // displacement so far, m
  double last_ = 0, one_before_ = 0;               // lengths of the last two steps, s
  equilibrium::Field velocity_, velocity_before_;  // mean velocities in them, m/s
};

}  // namespace hyperlattice::implicit
