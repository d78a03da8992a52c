// The ticks of the axes of all plots.
#pragma once

#include <string>
#include <vector>

namespace hyperlattice {

/// Returns 1, 2 or 5 times a power of ten, the smallest that divides a range into at most `most`
/// parts. Returns 1 if the range is not above 0 or not finite.
double round_step(double range, int most);

struct Tick {
  double value = 0;
  std::string label;  ///< with as many decimals as needed to distinguish the ticks
};

/// Returns multiples of 1, 2 or 5 times a power of ten in [low, high], about `most` of them and at
/// most `most` + 1. Returns none if low >= high or either is not finite. `whole`: ticks at whole
/// numbers only, for counts.
std::vector<Tick> round_ticks(double low, double high, int most, bool whole = false);

}  // namespace hyperlattice
