// Reads one value of a scene as an option wants it.
#pragma once

#include <scene/option_reader.hpp>

namespace hyperlattice {

/// A value with the storage that its spans point into.
struct ReadValue {
  OptionValue plain;
  std::vector<double> numbers;
  std::vector<std::string_view> texts;
};

/// Converts and checks `given`; `resolved` becomes the same in SI. False after faults.
bool read_value(const Option& option, const Json& given, const std::string& pointer,
                Reading reading, ReadValue& value, Json& resolved);

}  // namespace hyperlattice
