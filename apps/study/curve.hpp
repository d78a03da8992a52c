// A quantity over time or place, and how far one is from another.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice::study {

/// Values between which it runs straight. A single number is a curve of one point, at 0.
struct Curve {
  std::vector<double> over;    ///< time or place, ascending
  std::vector<double> values;  ///< as many
};

/// Puts the points in order; of several at one place their mean counts.
Curve sorted(Curve curve);

/// The value at a time or place within the curve's range (up to rounding); not a number outside.
double value_at(const Curve& curve, double over);

/// What is compared of a curve in place of all its points.
enum class Reduction { none, last, largest, least, mean };
inline constexpr std::string_view reduction_names[] = {"none", "last", "max", "min", "mean"};

/// The mean is over the range of the curve, not over its points.
Curve reduced(Curve curve, Reduction reduction);

/// How an error is counted, at the points x of the truth t that the observed curve u reaches:
enum class Norm {
  relative_l2,   ///< sqrt(sum (u - t)^2 / sum t^2)
  relative_max,  ///< max |u - t| / max |t|
  relative_end,  ///< |u - t| at the last of them / max |t|: the truth may pass zero there
  together_l2    ///< as relative_l2, with the sums over the points of all curves that are compared,
                 ///< as of the components of one vector
};
inline constexpr std::string_view norm_names[] = {"relative_l2", "relative_max", "relative_end",
                                                  "together_l2"};

/// How far a curve is from its truth, and how large that is: squares summed, or magnitudes.
struct Distance {
  double difference = 0, size = 0;

  /// Their ratio in the norm. Throws std::runtime_error, with a sentence, where the truth is zero.
  double relative(Norm norm) const;
};

/// Throws std::runtime_error, with a sentence, where the curves have nothing in common.
Distance distance(const Curve& observed, const Curve& truth, Norm norm);

}  // namespace hyperlattice::study
