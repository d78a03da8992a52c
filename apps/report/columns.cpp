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
  const auto whole = text.rfind('\n');
  columns.is_cut = whole != text.size() - 1 && !text.empty();
  if (whole == std::string_view::npos) {
    faults.add(file.string(), "", "a table whose first line names its columns");
    return columns;
  }
  std::size_t line = 0;
  for (std::size_t begin = 0, end = 0; begin <= whole; begin = end + 1) {
    end = text.find('\n', begin);
    const auto cells = csv_cells(text.substr(begin, end - begin));
    if (++line == 1) {
      columns.names = cells;
      columns.values.resize(cells.size());
      continue;
    }
    const std::string place = fmt::format("{} line {}", file.string(), line);
    if (cells.size() != columns.names.size()) {
      faults.add(place, fmt::format("{} cells", cells.size()),
                 fmt::format("{}, as in the first line", columns.names.size()));
      return columns;
    }
    std::vector<double> numbers(cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c)
      if (!read_number(cells[c], numbers[c])) {
        faults.add(place, fmt::format("\"{}\"", cells[c]),
                   fmt::format("a number in column \"{}\"", columns.names[c]));
        return columns;
      }
    for (std::size_t c = 0; c < cells.size(); ++c) columns.values[c].push_back(numbers[c]);
  }
  return columns;
}

}  // namespace hyperlattice::report
