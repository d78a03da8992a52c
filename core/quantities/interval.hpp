// Bounds of an expression by interval arithmetic: where it is certainly true, or certainly false.
#pragma once

#include <quantities/compiled.hpp>

#include <limits>

namespace hyperlattice {

/// All numbers from low to high.
struct Interval {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();

  bool is_point() const { return low == high; }
};

/// Returns an interval that contains the values of an expression for all inputs within the given
/// intervals. It may be wider than needed if an input stands at several places. Where a function
/// has no value, the interval is that of all numbers. It is computed with the same roundings as the
/// values, so bounds of sums, products and comparisons hold to the last bit.
Interval bounds(const Compiled& expression, std::span<const Interval> inputs);

}  // namespace hyperlattice
