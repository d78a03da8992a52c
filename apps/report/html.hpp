// Text, bytes and tables for a page that is both HTML and well-formed XML.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice::report {

/// Escapes text for use between tags or in quotes. Bytes that are not UTF-8 and characters that XML
/// does not allow become U+FFFD.
std::string escaped(std::string_view text);

/// Returns bytes as base64.
std::string base64(std::string_view bytes);

/// Returns "data:image/png;base64,..." for these bytes.
std::string data_uri(std::string_view media_type, std::string_view bytes);

/// A table of plain text, one vector for each row. The first cell of each row names the row; `head`
/// has the names of the columns, or is empty.
struct HtmlTable {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};
std::string table_html(const HtmlTable& table);

}  // namespace hyperlattice::report
