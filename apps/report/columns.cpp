#include <base/csv.hpp>
#include <report/columns.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>

namespace hyperlattice::report {

namespace {

/// Reads the number of a cell, which may be nan or infinite; returns false if the cell is no
/// number.
bool read_number(const std::string& cell, double& number) {
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  return error == std::errc() && end == cell.data() + cell.size();
}

}  // namespace

const std::vector<double>* Columns::find(std::string_view name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? nullptr : &values[static_cast<std::size_t>(found - names.begin())];
}

Columns read_columns(const std::filesystem::path& file, std::string_view text, Faults& faults) {
  Columns columns;
  const std::string_view whole = text.substr(0, text.rfind('\n') + 1);
  columns.is_cut = whole.size() < text.size();
  CsvReader table(whole);
  columns.names = table.columns();
  columns.values.resize(columns.names.size());
  if (columns.names.empty())
    faults.add(file.string(), "", "a table whose first line names its columns");
  const auto place = [&] { return fmt::format("{} line {}", file.string(), table.line()); };
  while (table.next()) {
    const std::vector<std::string>& cells = table.cells();
    if (cells.size() != columns.names.size()) {
      faults.add(place(), fmt::format("{} cells", cells.size()),
                 fmt::format("{}, as in the first line", columns.names.size()));
      return columns;
    }
    std::vector<double> numbers(cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c)
      if (!read_number(cells[c], numbers[c])) {
        faults.add(place(), fmt::format("\"{}\"", cells[c]),
                   fmt::format("a number in column \"{}\"", columns.names[c]));
        return columns;
      }
    for (std::size_t c = 0; c < cells.size(); ++c) columns.values[c].push_back(numbers[c]);
  }
  return columns;
}

}  // namespace hyperlattice::report
