// What an option accepts, in words; for faults and for documentation.
#pragma once

#include <hyperlattice/options.hpp>

namespace hyperlattice {

/// The range in words, with the unit: "above 0 m", "from 0 to 0.25"; empty if any number will do.
std::string range_text(const Option& option);
bool in_range(const Option& option, double value);

/// What was expected of a value: "a pressure of at least 0 Pa such as \"1 MPa\", or \"auto\"".
std::string expectation(const Option& option);
/// The same of one entry of a vector or list.
std::string entry_expectation(const Option& option);

/// "; did you mean \"I-m\"?" if a candidate is near, else nothing.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace hyperlattice
