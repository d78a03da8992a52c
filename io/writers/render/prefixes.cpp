#include "prefixes.hpp"

#include <hyperlattice/files.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace hyperlattice::render {

PrefixedUnit prefixed(std::string_view unit, double size) {
  /// A unit with the greatest power of 1000 that is usual with it.
  struct Known {
    std::string_view unit;
    int most;
  };
  constexpr Known known[] = {{"m", 1},   {"s", 0},    {"Pa", 3},  {"N", 3},
                             {"m/s", 1}, {"m/s2", 1}, {"J/m3", 3}};
  constexpr int least = -4;
  constexpr std::array<const char*, 8> prefixes{"p", "n", "\u00b5", "m", "", "k", "M", "G"};
  const auto* const found = std::find_if(std::begin(known), std::end(known),
                                         [unit](const Known& one) { return one.unit == unit; });
  if (found == std::end(known) || !(std::isfinite(size) && size > 0)) return {1, std::string(unit)};
  // A little more, so that 1e-3 gets the prefix of 1e-3.
  const double thousands = std::floor(std::log10(size * (1 + 1e-9)) / 3);
  const int power = std::clamp(static_cast<int>(thousands), least, found->most);
  return {std::pow(10.0, -3 * power),
          prefixes[static_cast<std::size_t>(power - least)] + std::string(unit)};
}

std::string number_text(double value, std::string_view unit, int digits) {
  const PrefixedUnit in = prefixed(unit, std::abs(value));
  return short_number(value * in.factor, digits) + " " + in.unit;
}

double round_below(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  const double share = most / power * (1 + 1e-9);
  return (share >= 5 ? 5 : share >= 2 ? 2 : 1) * power;
}

std::vector<double> ticks(double low, double high, int most) {
  if (!(high > low)) return {low};
  constexpr int tries = 5;  // two are enough but for round-off
  double step = round_below((high - low) / most), first = 0, count = 0;
  for (int n = 0; n < tries; ++n) {
    first = std::ceil(low / step - 1e-6);
    count = std::floor(high / step + 1e-6) - first + 1;
    if (count <= most) break;
    step = round_below(2.5 * step);  // the next of 1, 2, 5, 10
  }
  std::vector<double> values;
  for (int n = 0; n < most && n < count; ++n) values.push_back((first + n) * step + 0.0);  // not -0
  return values;
}

}  // namespace hyperlattice::render
