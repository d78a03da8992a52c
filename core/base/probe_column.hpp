// The names of a probe's columns: "displacement_x@(0.01 0 0)" is displacement_x at that place.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace hyperlattice {

/// Without the place.
std::string column_name(const std::string& column);

/// Metres; nothing if the name has no place.
std::optional<std::array<double, 3>> column_place(const std::string& column);

}  // namespace hyperlattice
