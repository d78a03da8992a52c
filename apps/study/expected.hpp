// What the truth says, as a curve.
#pragma once

#include <study/comparison.hpp>

#include <stdexcept>

namespace hyperlattice::study {

/// The truth of a comparison from a table or a number. `place`: where it is taken, if the
/// comparison has a place. `numbers`: what each axis was set to. Throws std::runtime_error with a
/// sentence if the truth does not reach there.
Curve true_curve(const Comparison& comparison, const Truth& truth, std::optional<double> place,
                 const std::vector<std::optional<double>>& numbers);

/// The runs are done, but no limit can be extrapolated from them; the sentence says why.
class NoLimit : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct SizedCurve {
  double size = 0;
  Curve curve;
};

/// Richardson: the curve at size 0 that the finest two lead to, if errors fall with the power
/// `order` of the size. The curves are ordered from the coarsest on; it has those points of the
/// second finest that the finest has too. Without an order, the one that the finest three show.
/// Throws NoLimit if they do not converge, or show an order that the method cannot have.
Curve extrapolated(const std::vector<SizedCurve>& curves, std::optional<double> order);

/// The order that three curves show: the differences between neighbours fall with this power of the
/// size. They are ordered from the coarsest on.
double order_of(const SizedCurve& coarse, const SizedCurve& middle, const SizedCurve& fine);

}  // namespace hyperlattice::study
