// The JSON type of scenes (objects keep the order of their keys), and how a scene's text becomes
// one.
#pragma once

#include <base/errors.hpp>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace hyperlattice {

using Json = nlohmann::ordered_json;

/// Parses JSON with comments into `json`. Duplicate keys are faults; so is wrong syntax, at its
/// line and column, and then the result is false.
bool parse_json(std::string_view text, Json& json, Faults& faults);

/// The JSON pointer of a member: "/pipeline" and "a/b" give "/pipeline/a~1b".
std::string member(const std::string& pointer, std::string_view key);
std::string member(const std::string& pointer, std::size_t index);

/// The text that an object has by that key; empty if it has none, or is no object.
std::string word_in(const Json& object, const char* key);

/// A document as text that ends with a newline. Bytes that are no UTF-8, as names of files may
/// have, become U+FFFD.
std::string json_text(const Json& document);
std::string json_text(const nlohmann::json& document);

/// Whether a text is UTF-8, as every text in JSON is.
bool is_utf8(const std::string& text);

/// A value as one line for a message, cut short if long.
std::string shown(const Json& value);

}  // namespace hyperlattice
