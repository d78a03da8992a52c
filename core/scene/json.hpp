// The JSON type of scenes, whose objects keep the order of their keys, and its parser.
#pragma once

#include <base/errors.hpp>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace hyperlattice {

using Json = nlohmann::ordered_json;

/// Parses JSON with comments into `json`. Adds a fault for each duplicate key. Wrong syntax adds a
/// fault with line and column, and the result is false.
bool parse_json(std::string_view text, Json& json, Faults& faults);

/// Returns the JSON pointer of a member: "/pipeline" and "a/b" give "/pipeline/a~1b".
std::string member(const std::string& pointer, std::string_view key);
std::string member(const std::string& pointer, std::size_t index);

/// Returns the text value of `key`; empty if `object` is no object or has no text there.
std::string word_in(const Json& object, const char* key);

/// Returns the document as text, with a newline at the end. Bytes that are not UTF-8, possible in
/// file names, become U+FFFD.
std::string json_text(const Json& document);
std::string json_text(const nlohmann::json& document);

/// Returns whether a text is valid UTF-8, as JSON requires.
bool is_utf8(const std::string& text);

/// Returns a value as one line for a message; a long value is cut.
std::string shown(const Json& value);

}  // namespace hyperlattice
