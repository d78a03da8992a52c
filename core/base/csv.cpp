#include <base/csv.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace hyperlattice {

std::vector<std::string> csv_cells(std::string_view line) {
  std::vector<std::string> cells(1);
  for (const char c : line)
    if (c == ',')
      cells.emplace_back();
    else if (c != '\r')
      cells.back() += c;
  return cells;
}

std::optional<double> csv_number(std::string_view cell) {
  double number = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

std::optional<std::size_t> CsvTable::column(std::string_view name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  return found == columns.end() ? std::nullopt : std::optional<std::size_t>(found - columns.begin());
}

CsvTable parse_csv(std::string_view text) {
  CsvTable table;
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
    end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    if (line.empty() || line == "\r") continue;
    if (table.columns.empty()) {
      table.columns = csv_cells(line);
    } else {
      table.rows.push_back(csv_cells(line));
      table.rows.back().resize(table.columns.size());
    }
  }
  return table;
}

}  // namespace hyperlattice
