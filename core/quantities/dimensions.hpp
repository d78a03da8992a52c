// Physical dimensions as powers of the base units, for arithmetic with quantities.
#pragma once

#include <array>
#include <string>

namespace hyperlattice {

/// The base units, in the order of Powers.
inline constexpr const char* base_units[] = {"m", "kg", "s", "K", "A", "mol", "cd", "rad"};

/// Powers of the base units: {1, 0, -2, ...} is an acceleration. Roots make them fractions.
using Powers = std::array<double, std::size(base_units)>;

/// A number with its dimension, or why there is none.
struct QuantityValue {
  double value = 0;  ///< SI
  Powers powers{};
  std::string problem;  ///< a sentence; empty: the value is valid
};

/// Returns the powers of a product, of a quotient, and of a quantity raised to a power.
Powers product(const Powers& a, const Powers& b);
Powers quotient(const Powers& a, const Powers& b);
Powers raised(const Powers& a, double power);

/// Returns whether both are the same dimension, to within round-off of the powers.
bool same(const Powers& a, const Powers& b);
bool is_plain_number(const Powers& powers);

/// Returns the SI unit of the powers as read_unit() reads it: "m kg s-2"; empty for a plain number.
/// Fractions are written with digits, "m0.5", which no unit has.
std::string unit_text_of(const Powers& powers);

/// Returns the dimension in words: "a length", "a number", "a quantity in m0.5".
std::string dimension_name(const Powers& powers);

}  // namespace hyperlattice
