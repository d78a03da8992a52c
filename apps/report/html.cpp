#include <report/html.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

namespace hyperlattice::report {

namespace {

/// Returns the text as valid UTF-8; the JSON library replaces invalid bytes.
std::string in_utf8(std::string_view text) {
  const std::string quoted =
      nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return nlohmann::json::parse(quoted).get<std::string>();
}

}  // namespace

std::string escaped(std::string_view text) {
  constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD
  std::string whole = in_utf8(text);
  for (const std::string_view no_character : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"})  // U+FFFE and U+FFFF
    for (std::size_t at = whole.find(no_character); at != std::string::npos;
         at = whole.find(no_character, at))
      whole.replace(at, 3, replacement);
  std::string out;
  for (const char c : whole) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      case '\n':
      case '\t':
        out += c;
        break;
      default:
        if (static_cast<unsigned char>(c) < 0x20)
          out += replacement;
        else
          out += c;
    }
  return out;
}

std::string base64(std::string_view bytes) {
  static constexpr char digits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve(4 * (bytes.size() / 3 + 1));
  for (std::size_t n = 0; n < bytes.size(); n += 3) {
    const std::size_t here = std::min<std::size_t>(3, bytes.size() - n);
    unsigned bits = 0;
    for (std::size_t b = 0; b < 3; ++b)
      bits = bits << 8 | (b < here ? static_cast<unsigned char>(bytes[n + b]) : 0u);
    for (std::size_t d = 0; d < 4; ++d) out += d <= here ? digits[bits >> (18 - 6 * d) & 63] : '=';
  }
  return out;
}

std::string data_uri(std::string_view media_type, std::string_view bytes) {
  return fmt::format("data:{};base64,{}", media_type, base64(bytes));
}

std::string table_html(const HtmlTable& table) {
  std::string out = "<div class=\"wide\"><table>\n";
  const auto row = [&](const std::vector<std::string>& cells, bool is_head) {
    out += "<tr>";
    for (std::size_t n = 0; n < cells.size(); ++n)
      fmt::format_to(std::back_inserter(out), "<{0}>{1}</{0}>", is_head || n == 0 ? "th" : "td",
                     escaped(cells[n]));
    out += "</tr>\n";
  };
  if (!table.head.empty()) row(table.head, true);
  for (const auto& cells : table.rows) row(cells, false);
  return out + "</table></div>\n";
}

}  // namespace hyperlattice::report
