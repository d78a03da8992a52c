// Names of a probe's columns: "displacement_x@(0.01 0 0)" is displacement_x at that position.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace hyperlattice {

/// Returns the name without the position.
std::string column_name(const std::string& column);

/// Returns the position, m; nothing if the name has none.
std::optional<std::array<double, 3>> column_place(const std::string& column);

}  // namespace hyperlattice
