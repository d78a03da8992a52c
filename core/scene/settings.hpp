// `--set /pointer=value`, `--set name/option=value`: changes of a scene by the command line, before
// validation.
#pragma once

#include <scene/json.hpp>

#include <vector>

namespace hyperlattice {

/// Parses the text as JSON. If it is not JSON, returns the text itself as a JSON string.
Json value_of(const std::string& text);

/// Replaces the value at a JSON pointer, or adds a member to an existing object or array. Returns
/// an empty text after success, otherwise what was expected.
std::string set_value(Json& document, std::string_view pointer, const Json& value);

/// Applies settings "/pointer=value", or "name/option=value" with the stage of find_stage(), with
/// set_value(). The part after the first "=" is read by value_of().
void apply_settings(Json& scene, const std::vector<std::string>& settings, Faults& faults);

}  // namespace hyperlattice
