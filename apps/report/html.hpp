// Text, bytes and tables in a page that is both HTML and well-formed XML.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice::report {

/// Text that can stand between tags or in quotes. What is not UTF-8, or a character that XML does
/// not allow, becomes U+FFFD.
std::string escaped(std::string_view text);

/// "data:image/png;base64,...".
std::string data_uri(std::string_view media_type, std::string_view bytes);

/// One row a vector. The first cell of each names the row; with `head`, those are the names of the
/// columns. Cells are plain text.
struct HtmlTable {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};
std::string table_html(const HtmlTable& table);

}  // namespace hyperlattice::report
