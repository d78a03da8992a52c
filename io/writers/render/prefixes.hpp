// Numbers with SI prefixes, for texts in pictures.
#pragma once

#include <hyperlattice/plain.hpp>

#include <string>
#include <vector>

namespace hyperlattice::render {

/// A unit with a prefix, and what numbers in SI are multiplied with.
struct PrefixedUnit {
  double factor = 1;
  std::string unit;
};

/// Returns the unit in which a number of this size has one to three digits before the point, as far
/// as the usual prefixes of the unit go: no kiloseconds. Other units stay as they are.
PrefixedUnit prefixed(std::string_view unit, double size);

/// Returns a number with its unit: "12.5 mm".
std::string number_text(double value, std::string_view unit, int digits = 4);

/// Returns the largest number 1, 2 or 5 times a power of ten that is at most `most`, which is above
/// 0.
double round_below(double most);

/// Returns round numbers between two numbers, at most `most` of them.
std::vector<double> ticks(double low, double high, int most);

}  // namespace hyperlattice::render
