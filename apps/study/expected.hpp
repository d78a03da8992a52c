// The truth as a curve.
#pragma once

#include <study/comparison.hpp>

#include <stdexcept>

namespace hyperlattice::study {

/// Returns the truth of a comparison from a table or a number. `place`: m, if the comparison has a
/// place. `numbers`: the value of each axis, if it is a number. Throws std::runtime_error with a
/// sentence if the truth has no value there.
Curve true_curve(const Comparison& comparison, const Truth& truth, std::optional<double> place,
                 const std::vector<std::optional<double>>& numbers);

/// The runs are done, but no limit can be extrapolated from them; the message says why.
class NoLimit : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The curve of a run with its size (spacing, time step).
struct SizedCurve {
  double size = 0;
  Curve curve;
};

/// Returns the limit at size 0 by Richardson extrapolation from the finest two curves, if errors
/// fall with the power `order` of the size; without `order`, with the order that the finest three
/// show. The curves are ordered from the coarsest to the finest; the limit has the points of the
/// second finest that the finest has too. Throws NoLimit if the curves do not converge, or show an
/// order that the method cannot have.
Curve extrapolated(const std::vector<SizedCurve>& curves, std::optional<double> order);

/// Returns the order that three curves show: the differences between neighbours fall with this
/// power of the size. Throws as extrapolated does.
double order_of(const SizedCurve& coarse, const SizedCurve& middle, const SizedCurve& fine);

}  // namespace hyperlattice::study
