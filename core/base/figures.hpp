// Numbers for people, as they stand in plans and reports: the same words everywhere, no locale.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace hyperlattice {

/// "490 432": thousands apart.
std::string count_text(std::uint64_t number);
std::string count_text_of(
    double number);  ///< of a count that was read as a number; what is none counts as 0

/// "1.25 GB".
std::string bytes_text(double bytes);

/// "0.37 %" of 0.0037, three digits.
std::string percent_text(double share);

/// What numbers are divided by to be readable, and their unit then.
struct Scale {
  double factor = 1;  ///< of the unit
  std::string
      unit;  ///< "us" is written with a Greek mu; "10⁻⁵" for numbers without a unit; may be empty
};

/// Brings the largest magnitude to between 1 and 1000 by the prefix of a unit in SI ("s", "m/s", "N
/// s"), or by a power of ten of numbers without a unit that are below 1e-3 or from 1e5 on. A unit
/// that bears no prefix ("kg", "%") stays.
Scale scale_for(double largest, std::string_view unit);

/// "1.81 µs": `digits` significant digits and the unit with its prefix.
std::string quantity_text(double value, std::string_view unit, int digits = 4);

}  // namespace hyperlattice
