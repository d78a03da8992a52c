// The ticks of an axis.
#pragma once

#include <string>
#include <vector>

namespace hyperlattice::report {

struct Tick {
  double value = 0;
  std::string label;  ///< with as many decimals as needed to distinguish the ticks
};

/// Returns multiples of 1, 2 or 5 times a power of ten in [low, high], about `most` of them and at
/// most `most` + 1. Returns none if low >= high or either is not finite. `whole`: ticks at whole
/// numbers only, for counts.
std::vector<Tick> round_ticks(double low, double high, int most, bool whole = false);

}  // namespace hyperlattice::report
