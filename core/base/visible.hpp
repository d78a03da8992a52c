// Text from an input or a plugin in a form that is safe to show in a message.
#pragma once

#include <string>
#include <string_view>

namespace hyperlattice {

/// Returns the text with invisible characters (control characters except line ends, no-break
/// spaces, marks without width) as "U+00A0"; cut after `most` bytes, with "..." at the end. Bytes
/// that are not UTF-8 stay.
std::string visible(std::string_view text, std::size_t most);

/// Returns the same in one line: line ends become spaces; those at the end are dropped.
std::string visible_line(std::string_view text, std::size_t most);

/// Returns the number of bytes of the first character of a text that is not empty.
std::size_t length_of_character(std::string_view text);

}  // namespace hyperlattice
