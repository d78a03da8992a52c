// Numbers as text in plans and reports, in one format everywhere and independent of the locale.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace hyperlattice {

/// Returns a count with a space between thousands: "490 432".
std::string count_text(std::uint64_t number);
/// Returns the same for a count read as a double; negative or NaN counts as 0
std::string count_text_of(double number);

/// Returns an amount of memory: "1.25 GB".
std::string bytes_text(double bytes);

/// Returns a share in percent, three digits: "0.37 %" for 0.0037.
std::string percent_text(double share);

/// A divisor for readable numbers, and the unit after the division.
struct Scale {
  double factor = 1;  ///< divisor
  /// unit with prefix (micro is a Greek mu); "10⁻⁵" for numbers without a unit; may be empty
  std::string unit;
};

/// Returns the scale that brings the largest magnitude to between 1 and 1000: by the prefix of an
/// SI unit ("s", "m/s", "N s"), or by a power of ten for numbers without a unit that are below 1e-3
/// or at least 1e5. A unit that takes no prefix ("kg", "%") stays.
Scale scale_for(double largest, std::string_view unit);

/// Returns a value with `digits` significant digits and the unit with its prefix: "1.81 µs".
std::string quantity_text(double value, std::string_view unit, int digits = 4);

}  // namespace hyperlattice
