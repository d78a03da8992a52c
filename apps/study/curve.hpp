// Curves (a quantity over time or place), and the distance between two of them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice::study {

/// A piecewise linear curve. A single number is a curve of one point, at 0.
struct Curve {
  std::vector<double> over;    ///< time or place, ascending
  std::vector<double> values;  ///< of the same length
};

/// Sorts the points; several points at one place become their mean.
Curve sorted(Curve curve);

/// Returns the value at a time or place in the range of the curve (up to rounding); NaN outside.
double value_at(const Curve& curve, double over);

/// One number of a curve that is compared in place of all points.
enum class Reduction { none, last, largest, least, mean };
inline constexpr std::string_view reduction_names[] = {"none", "last", "max", "min", "mean"};

/// Reduces a curve to one number. The mean is the integral over the range, not the mean of the
/// points.
Curve reduced(Curve curve, Reduction reduction);

/// The norm of an error, over the points x of the truth t that the observed curve u reaches:
enum class Norm {
  relative_l2,   ///< sqrt(sum (u - t)^2 / sum t^2)
  relative_max,  ///< max |u - t| / max |t|
  relative_end,  ///< |u - t| at the last point / max |t|, since t may be 0 there
  together_l2    ///< as relative_l2, with sums over the points of all compared curves, like
                 ///< components of one vector
};
inline constexpr std::string_view norm_names[] = {"relative_l2", "relative_max", "relative_end",
                                                  "together_l2"};

/// The distance of a curve from its truth, and the size of the truth: sums of squares or maxima, as
/// the norm needs.
struct Distance {
  double difference = 0, size = 0;

  /// Returns their ratio in the norm. Throws std::runtime_error with a sentence if the truth is
  /// zero.
  double relative(Norm norm) const;
};

/// Returns the distance of two curves. Throws std::runtime_error with a sentence if they have no
/// points in common.
Distance distance(const Curve& observed, const Curve& truth, Norm norm);

}  // namespace hyperlattice::study
