// Whether what a plugin registers can be used: names, options, and every function of its family.
#pragma once

#include <hyperlattice/component.hpp>

#include <string>

namespace hyperlattice {

/// Whether the text has the form "<family>.<name>", the name in small letters, digits and
/// underscores.
bool is_type_name(std::string_view text);

/// What is wrong with a component, or an empty text.
std::string component_fault(const ComponentInfo& info);

}  // namespace hyperlattice
