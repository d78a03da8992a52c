// Reads one value of a scene according to the declaration of its option.
#pragma once

#include <scene/option_reader.hpp>

namespace hyperlattice {

/// A value and the storage to which its spans point.
struct ReadValue {
  OptionValue plain;
  std::vector<double> numbers;
  std::vector<std::string_view> texts;
};

/// Converts and checks `given`; `resolved` gets the same value in SI units. Returns false after
/// faults.
bool read_value(const Option& option, const Json& given, const std::string& pointer,
                Reading reading, ReadValue& value, Json& resolved);

}  // namespace hyperlattice
