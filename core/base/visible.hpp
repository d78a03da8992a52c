// Text from an input or a plugin as a message shows it.
#pragma once

#include <string>
#include <string_view>

namespace hyperlattice {

/// The text, characters that nobody sees (control characters but the end of a line, no-break
/// spaces, marks without width) as "U+00A0", cut behind `most` bytes with "...". Bytes that are no
/// UTF-8 stay as they are.
std::string visible(std::string_view text, std::size_t most);

/// The same in one line: ends of lines are spaces, and none stands at the end.
std::string visible_line(std::string_view text, std::size_t most);

/// Bytes of the character at the start of a text that is not empty.
std::size_t length_of_character(std::string_view text);

}  // namespace hyperlattice
