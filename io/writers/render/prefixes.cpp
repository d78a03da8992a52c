#include "prefixes.hpp"

#include <hyperlattice/files.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace hyperlattice::render {

PrefixedUnit prefixed(std::string_view unit, double size) {
  constexpr std::string_view known[] = {"m", "s", "Pa", "N", "m/s", "m/s2", "J/m3"};
  constexpr std::array<const char*, 7> prefixes{"n", "\u00b5", "m", "", "k", "M", "G"};
  if (std::find(std::begin(known), std::end(known), unit) == std::end(known) ||
      !(std::isfinite(size) && size > 0))
    return {1, std::string(unit)};
  // A little more, so that 1e-3 gets the prefix of 1e-3.
  const int thousands =
      std::clamp(static_cast<int>(std::floor(std::log10(size * (1 + 1e-9)) / 3)), -3, 3);
  return {std::pow(10.0, -3 * thousands),
          prefixes[static_cast<std::size_t>(thousands + 3)] + std::string(unit)};
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
