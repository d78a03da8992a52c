// The grammar of units, checked before UDUNITS reads a unit: symbols with whole powers, products
// and quotients, nothing else. Examples: "1/s", "kg/m3", "Pa s", "N.m", "W/m/K", "kg/(m s2)";
// powers "m2", "m^2", "s-1", "m²".
//   unit     = ["1"] {quotient} | product {quotient}
//   quotient = "/" (factor | "(" product ")")
//   product  = factor {(blank | "." | "*" | "·") factor}
//   factor   = symbol [["^" | "**"] ["+" | "-"] digits], or superscript digits
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice {

/// One factor of a unit.
struct UnitFactor {
  std::string_view symbol;  ///< symbol with its prefix; points into the text that was read
  int power = 1;
};

/// The result of read_unit().
struct UnitText {
  std::vector<UnitFactor> factors;
  std::string problem;  ///< why the text is no unit, as a sentence; empty: it is a unit
};

/// Reads a unit (without a number). Refuses a product after "/" without parentheses, since "W/m K"
/// has two common meanings.
UnitText read_unit(std::string_view text);

/// Returns the text without blanks (also no-break spaces) at its ends.
std::string_view trim_blanks(std::string_view text);

/// Returns the text for a message: in quotation marks, cut if it is long.
std::string quoted(std::string_view text);

}  // namespace hyperlattice
