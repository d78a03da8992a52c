// `--set /pointer=value`: changes to a scene from the command line, made before it is validated.
#pragma once

#include <scene/json.hpp>

#include <vector>

namespace hyperlattice {

/// Text as a value: JSON if it is some, else the text itself.
Json value_of(const std::string& text);

/// Replaces the value at a JSON pointer, or adds a member to an object or array that is there.
/// Returns what was expected instead; empty: it is done.
std::string set_value(Json& document, std::string_view pointer, const Json& value);

/// Each setting replaces the value at its pointer, or adds a member to an object or array that is
/// there. What stands behind the first "=" is read as JSON; if it is none, as a text.
void apply_settings(Json& scene, const std::vector<std::string>& settings, Faults& faults);

}  // namespace hyperlattice
