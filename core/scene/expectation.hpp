// Descriptions in words of the values that an option accepts; for faults and documentation.
#pragma once

#include <hyperlattice/options.hpp>

namespace hyperlattice {

/// Returns the range with its unit: "above 0 m", "from 0 to 0.25"; empty if any number is valid.
std::string range_text(const Option& option);
/// Returns whether the value is in the option's range.
bool in_range(const Option& option, double value);

/// Returns the expected value: "a pressure of at least 0 Pa such as \"1 MPa\", or \"auto\"".
std::string expectation(const Option& option);
/// Returns the same description for one entry of a vector or list.
std::string entry_expectation(const Option& option);

/// Returns "; did you mean \"I-m\"?" if a candidate has a similar spelling, otherwise nothing.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace hyperlattice
