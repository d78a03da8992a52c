#include <base/csv.hpp>

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

/// Columns and the number of the line that names them.
struct NamedColumns {
  TableColumns columns;
  std::size_t line = 0;
};

/// Returns the columns that a comment in `lines` names for the row that follows; nothing if there
/// is no comment.
std::optional<NamedColumns> columns_in_comments(std::string_view lines, std::string_view row) {
  std::optional<NamedColumns> found;
  bool found_fits = false;
  for (std::size_t number = 1; !lines.empty(); ++number) {
    const std::string_view line = take_line(lines);
    if (!TableColumns::is_comment(line)) continue;
    TableColumns columns(line);
    const bool fits = columns.cells(row).size() == columns.names().size();
    if (found_fits && !fits) continue;
    found = {std::move(columns), number};
    found_fits = fits;
  }
  return found;
}

}  // namespace

CsvReader::CsvReader(std::string_view text) : rest_(text), columns_("") {
  while (names_.empty() && !rest_.empty()) {
    const std::string_view here = rest_, above = text.substr(0, text.size() - here.size()),
                           line = take_line(rest_);
    ++line_;
    if (TableColumns::is_empty(line)) continue;
    columns_ = TableColumns(line);
    columns_line_ = line_;
    if (auto named =
            holds_number(columns_.names()) ? columns_in_comments(above, line) : std::nullopt) {
      columns_ = std::move(named->columns);
      columns_line_ = named->line;
      rest_ = here;  // the line is a row
      --line_;
    }
    names_ = columns_.names();
  }
}

bool CsvReader::next() {
  while (!rest_.empty()) {
    const std::string_view line = take_line(rest_);
    ++line_;
    if (TableColumns::is_empty(line)) continue;
    cells_ = columns_.cells(line);
    return true;
  }
  return false;
}

std::string CsvReader::fault() const {
  if (std::string excess = columns_.excess(cells_); !excess.empty()) return excess;
  const std::size_t needed = columns_.count();
  return cells_.size() < needed ? "a row of " + std::to_string(needed) + " cells, not of " +
                                      std::to_string(cells_.size())
                                : "";
}

CsvTable parse_csv(std::string_view text) {
  CsvReader reader(text);
  CsvTable table;
  table.columns = reader.columns();
  while (reader.next()) {
    table.rows.push_back(reader.cells());
    table.rows.back().resize(table.columns.size());
    table.lines.push_back(reader.line());
    if (table.faults.size() < most_faults)
      if (std::string fault = reader.fault(); !fault.empty())
        table.faults.push_back({reader.line(), std::move(fault)});
  }
  return table;
}

}  // namespace hyperlattice
