#include <base/visible.hpp>

#include <spdlog/fmt/fmt.h>

#include <cstdint>
#include <iterator>

namespace hyperlattice {

namespace {

std::uint32_t code_of(std::string_view character) {
  const auto lead = static_cast<unsigned char>(character.front());
  std::uint32_t code =
      character.size() == 1 || character.size() > 4 ? lead : lead & (0x7FU >> character.size());
  for (const char c : character.substr(1))
    code = code << 6 | (static_cast<unsigned char>(c) & 0x3FU);
  return code;
}

bool is_unseen(std::string_view character) {
  const std::uint32_t code = code_of(character);
  if (character.size() == 1) return (code < 0x20 && code != '\n') || code == 0x7F;
  return (code >= 0x80 && code <= 0xA0) || code == 0xAD || (code >= 0x2000 && code <= 0x200F) ||
         (code >= 0x2028 && code <= 0x202F) || (code >= 0x205F && code <= 0x206F) ||
         code == 0x3000 || code == 0xFEFF;
}

}  // namespace

std::size_t length_of_character(std::string_view text) {
  std::size_t length = 1;
  while (length < text.size() && (static_cast<unsigned char>(text[length]) & 0xC0) == 0x80)
    ++length;
  return length;
}

std::string visible(std::string_view text, std::size_t most) {
  std::string shown;
  while (!text.empty()) {
    const std::string_view character = text.substr(0, length_of_character(text));
    if (shown.size() + character.size() > most) return shown + "...";
    if (is_unseen(character))
      fmt::format_to(std::back_inserter(shown), "U+{:04X}", code_of(character));
    else
      shown += character;
    text.remove_prefix(character.size());
  }
  return shown;
}

std::string visible_line(std::string_view text, std::size_t most) {
  text = text.substr(0, text.find_last_not_of("\r\n") + 1);
  std::string line;
  for (std::size_t n = 0; n < text.size(); ++n)
    if (!text.substr(n).starts_with("\r\n")) line += text[n] == '\n' ? ' ' : text[n];
  return visible(line, most);
}

}  // namespace hyperlattice
