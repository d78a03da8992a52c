// Checks of the components that a plugin registers: names, options, and all functions of the
// family.
#pragma once

#include <hyperlattice/component.hpp>

#include <cstddef>
#include <string>
#include <string_view>

namespace hyperlattice {

/// Longest text of a plugin that is shown, bytes. A longer one is most likely a length that was
/// never set.
inline constexpr std::size_t longest_text = 1 << 16;

/// Returns whether the text has the form "<family>.<name>", with a name of small letters, digits
/// and underscores.
bool is_type_name(std::string_view text);

/// Returns what is wrong with a component; empty if nothing is wrong.
std::string component_fault(const ComponentInfo& info);

}  // namespace hyperlattice
