// Quantities with units. UDUNITS-2 knows the units; numbers are parsed and scaled here, so that "1
// mm" is the double nearest to 0.001.
#pragma once

#include <string>
#include <string_view>

namespace hyperlattice {

/// What a unit measures, in words.
struct Dimension {
  std::string
      name;  ///< "a length"; "a number" if dimensionless; "a quantity in m4" if it has no name
  std::string example;  ///< "1 mm"; without unit if dimensionless
};
Dimension dimension_of(std::string_view unit);

struct Quantity {
  double value = 0;     ///< in SI units; finite
  std::string problem;  ///< why there is none: "unknown unit \"MPaa\""; empty: all is well
};

/// Reads "<number> <unit>" as a quantity of the same dimension as `unit` (an SI unit, or empty for
/// a plain number, which takes "%"). Safe in threads. Throws OutsideError if the units database
/// cannot be read.
Quantity read_quantity(std::string_view text, std::string_view unit);

}  // namespace hyperlattice
