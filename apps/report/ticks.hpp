// The marks of an axis.
#pragma once

#include <string>
#include <vector>

namespace hyperlattice::report {

struct Tick {
  double value = 0;
  std::string label;  ///< with as many decimals as tell the ticks apart
};

/// Multiples of 1, 2 or 5 times a power of ten within [low, high], about `most` of them and never
/// more than one above that. Empty if low >= high or either is not finite. `whole`: of counts,
/// between which nothing is.
std::vector<Tick> round_ticks(double low, double high, int most, bool whole = false);

}  // namespace hyperlattice::report
