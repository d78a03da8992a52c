#include <base/csv.hpp>

#include <hyperlattice/tables.hpp>

namespace hyperlattice {

std::vector<std::string> csv_cells(std::string_view line) { return TableColumns(line).names(); }

std::optional<double> csv_number(std::string_view cell) { return table_number(cell); }

std::optional<std::size_t> CsvTable::column(std::string_view name) const { return find_column(columns, name); }

CsvTable parse_csv(std::string_view text) {
  CsvTable table;
  std::optional<TableColumns> columns;
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
    end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    if (!columns) {
      if (TableColumns::is_blank(line)) continue;
      table.columns = columns.emplace(line).names();
    } else if (!TableColumns::is_empty(line)) {
      table.rows.push_back(columns->cells(line));
      table.rows.back().resize(table.columns.size());
    }
  }
  return table;
}

}  // namespace hyperlattice
