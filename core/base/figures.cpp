#include <base/figures.hpp>

#include <hyperlattice/files.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace hyperlattice {

namespace {

// powers of ten of the first and the last prefix below
constexpr int least_power = -18, greatest_power = 12;

std::string superscript(int number) {
  static constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char c : fmt::format("{}", number)) text += c == '-' ? "⁻" : digits[c - '0'];
  return text;
}

/// Returns whether the unit can take a prefix: its first factor has the power 1. The prefix of "m2"
/// would be squared.
bool bears_prefix(std::string_view unit) {
  static constexpr std::array<std::string_view, 7> units = {"s", "m", "N", "J", "Pa", "Hz", "W"};
  const std::string_view first = unit.substr(0, unit.find_first_of(" /"));
  return std::find(units.begin(), units.end(), first) != units.end();
}

/// Returns the largest multiple of three that is at most the power of ten of the magnitude.
int power_of_thousand(double largest) {
  return 3 * static_cast<int>(std::floor(std::log10(largest) / 3 + 1e-12));
}

}  // namespace

std::string count_text(std::uint64_t number) {
  if (number < 1000) return fmt::format("{}", number);
  return fmt::format("{} {:03}", count_text(number / 1000), number % 1000);
}

std::string count_text_of(double number) {
  return count_text(number > 0 ? static_cast<std::uint64_t>(std::min(std::round(number), 1e18))
                               : 0);
}

std::string bytes_text(double bytes) {
  static constexpr const char* units[] = {"B", "kB", "MB", "GB", "TB"};
  std::size_t unit = 0;
  while (bytes >= 1000 && unit + 1 < std::size(units)) {
    bytes /= 1000;
    ++unit;
  }
  return fmt::format("{:.3g} {}", bytes, units[unit]);
}

std::string percent_text(double share) { return short_number(100 * share, 3) + " %"; }

Scale scale_for(double largest, std::string_view unit) {
  static constexpr const char* prefixes[] = {"a", "f", "p", "n", "µ", "m", "", "k", "M", "G", "T"};
  Scale scale{1, std::string(unit)};
  if (!std::isfinite(largest) || !(largest > 0)) return scale;
  if (unit.empty()) {
    if (largest >= 1e-3 && largest < 1e5) return scale;
    const int power = power_of_thousand(largest);
    return {std::pow(10.0, power), "10" + superscript(power)};
  }
  if (!bears_prefix(unit)) return scale;
  const int power = std::clamp(power_of_thousand(largest), least_power, greatest_power);
  return {std::pow(10.0, power), prefixes[(power - least_power) / 3] + scale.unit};
}

std::string quantity_text(double value, std::string_view unit, int digits) {
  if (unit.empty()) return short_number(value, digits);
  const Scale scale = scale_for(std::abs(value), unit);
  return short_number(value / scale.factor, digits) + " " + scale.unit;
}

}  // namespace hyperlattice
