#include <base/visible.hpp>
#include <study/text_table.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace hyperlattice::study {

std::string shown_whole(const std::string& text) { return visible(text, std::string::npos); }

std::string aligned(const Lines& lines, std::size_t left) {
  std::vector<std::size_t> widths;
  for (const auto& line : lines) {
    widths.resize(std::max(widths.size(), line.size()));
    for (std::size_t c = 0; c < line.size(); ++c) widths[c] = std::max(widths[c], line[c].size());
  }
  std::string text;
  for (const auto& line : lines) {
    std::string row;
    for (std::size_t c = 0; c < line.size(); ++c)
      row += c < left ? fmt::format("  {:<{}}", line[c], widths[c])
                      : fmt::format("  {:>{}}", line[c], widths[c]);
    row.erase(row.find_last_not_of(' ') + 1);
    text += row + '\n';
  }
  return text;
}

}  // namespace hyperlattice::study
