#include <base/csv.hpp>

#include <hyperlattice/tables.hpp>

namespace hyperlattice {

std::vector<std::string> csv_cells(std::string_view line) { return TableColumns(line).names(); }

std::optional<double> csv_number(std::string_view cell) { return table_number(cell); }

std::optional<std::size_t> CsvTable::column(std::string_view name) const { return find_column(columns, name); }

namespace {

bool holds_number(const std::vector<std::string>& cells) {
  return std::any_of(cells.begin(), cells.end(), [](const std::string& cell) { return table_number(cell).has_value(); });
}

/// Cuts the first line off the text.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

/// The columns that a comment among these lines names for the row that follows them; nothing if there is no comment.
std::optional<TableColumns> columns_in_comments(std::string_view lines, std::string_view row) {
  std::optional<TableColumns> found;
  bool found_fits = false;
  while (!lines.empty()) {
    const std::string_view line = take_line(lines);
    if (!TableColumns::is_comment(line)) continue;
    TableColumns columns(line);
    const bool fits = columns.cells(row).size() == columns.names().size();
    if (found_fits && !fits) continue;
    found = std::move(columns);
    found_fits = fits;
  }
  return found;
}

}  // namespace

CsvTable parse_csv(std::string_view text) {
  CsvTable table;
  std::optional<TableColumns> columns;
  for (std::string_view rest = text; !rest.empty();) {
    const std::string_view above = text.substr(0, text.size() - rest.size()), line = take_line(rest);
    if (TableColumns::is_empty(line)) continue;
    bool is_row = true;
    if (!columns) {
      if (holds_number(TableColumns(line).names())) columns = columns_in_comments(above, line);
      is_row = columns.has_value();
      if (!columns) columns.emplace(line);
      table.columns = columns->names();
    }
    if (!is_row) continue;
    table.rows.push_back(columns->cells(line));
    table.rows.back().resize(table.columns.size());
  }
  return table;
}

}  // namespace hyperlattice
