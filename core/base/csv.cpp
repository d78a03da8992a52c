#include <base/csv.hpp>

#include <hyperlattice/tables.hpp>

#include <set>

namespace hyperlattice {

std::vector<std::string> csv_cells(std::string_view line) { return TableColumns(line).names(); }

std::optional<double> csv_number(std::string_view cell) { return table_number(cell); }

std::optional<std::size_t> CsvTable::column(std::string_view name) const {
  return find_column(columns, name);
}

std::optional<std::string> name_of_several(const CsvTable& table) {
  std::set<std::string_view> seen;
  for (const std::string& name : table.columns)
    if (!name.empty() && !seen.insert(name).second) return name;
  return std::nullopt;
}

namespace {

constexpr std::size_t most_faults = 5;

bool holds_number(const std::vector<std::string>& cells) {
  return std::any_of(cells.begin(), cells.end(),
                     [](const std::string& cell) { return table_number(cell).has_value(); });
}

/// Cuts the first line off the text.
std::string_view take_line(std::string_view& text) {
  const auto* const ending =
      std::find_if(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; });
  const auto end = static_cast<std::size_t>(ending - text.begin());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end);
  text.remove_prefix(text.starts_with("\r\n") ? 2 : std::min<std::size_t>(1, text.size()));
  return line;
}

/// Returns what is wrong with the number of cells of a row; empty if it is right. Columns without a
/// name at the end need no cell.
std::string fault_of_length(const TableColumns& columns, const std::vector<std::string>& cells) {
  if (std::string excess = columns.excess(cells); !excess.empty()) return excess;
  const std::size_t needed = columns.count();
  return cells.size() < needed ? "a row of " + std::to_string(needed) + " cells, not of " +
                                     std::to_string(cells.size())
                               : "";
}

/// Returns the columns that a comment in `lines` names for the row that follows; nothing if there
/// is no comment.
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
  std::size_t number = 0;
  for (std::string_view rest = text; !rest.empty();) {
    ++number;
    const std::string_view above = text.substr(0, text.size() - rest.size()),
                           line = take_line(rest);
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
    table.lines.push_back(number);
    if (table.faults.size() < most_faults)
      if (std::string fault = fault_of_length(*columns, table.rows.back()); !fault.empty())
        table.faults.push_back({number, std::move(fault)});
    table.rows.back().resize(table.columns.size());
  }
  return table;
}

}  // namespace hyperlattice
