// The grammar of units, which holds before UDUNITS sees them: symbols with whole powers, products
// and quotients, and nothing else.
//   unit    = ["1"] {quotient} | product {quotient}        "1/s", "kg/m3", "Pa s", "N.m", "W/m/K",
//   "kg/(m s2)" quotient = "/" (factor | "(" product ")") product = factor {(blank | "." | "*" |
//   "·") factor} factor  = symbol [["^" | "**"] ["+" | "-"] digits], or digits above the line:
//   "m2", "m^2", "s-1", "m²"
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice {

struct UnitFactor {
  std::string_view symbol;  ///< with its prefix; a part of the text that was read
  int power = 1;
};

struct UnitText {
  std::vector<UnitFactor> factors;
  std::string problem;  ///< why the text is no unit, as a sentence; empty: it is one
};

/// Reads a unit without a number before it. A product after "/" without parentheses is refused:
/// people disagree on what "W/m K" means.
UnitText read_unit(std::string_view text);

/// The text without blanks at its ends, no-break spaces among them.
std::string_view trim_blanks(std::string_view text);

/// The text for a message: in quotation marks, cut if it is long.
std::string quoted(std::string_view text);

}  // namespace hyperlattice
