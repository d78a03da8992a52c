// Quantities with units. UDUNITS-2 provides the units; this file parses and scales the numbers, so
// that "1 mm" is the double nearest to 0.001.
#pragma once

#include <quantities/dimensions.hpp>

#include <string>
#include <string_view>

namespace hyperlattice {

/// The physical dimension of a unit, in words.
struct Dimension {
  /// "a length"; "a number" if dimensionless; "a quantity in m4" if the dimension has no name
  std::string name;
  std::string example;  ///< example of a value: "1 mm"; without unit if dimensionless
};
/// Returns the dimension of an SI unit.
Dimension dimension_of(std::string_view unit);

/// The result of read_quantity().
struct Quantity {
  double value = 0;  ///< in SI units; finite
  /// why the text is no such quantity: "unknown unit \"MPaa\""; empty: no problem
  std::string problem;
};

/// Reads "<number> <unit>" as a quantity of the same dimension as `unit`. `unit` is an SI unit; if
/// it is empty, the text is a plain number or a percentage ("%"). Thread-safe. Throws OutsideError
/// if the units database cannot be read.
Quantity read_quantity(std::string_view text, std::string_view unit);

/// Reads "<number> <unit>" as a quantity of any dimension. The text begins with the number; "%" is
/// a hundredth. Thread-safe. Throws as read_quantity().
QuantityValue read_any_quantity(std::string_view text);

}  // namespace hyperlattice
