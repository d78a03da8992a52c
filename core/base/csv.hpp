// Tables as text: cells between commas, the first line names the columns. No quotation marks: no table here has a comma within a cell.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice {

std::vector<std::string> csv_cells(std::string_view line);

/// The cell's number; nothing if it is none, or not finite.
std::optional<double> csv_number(std::string_view cell);

struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< each as long as the columns; short lines are filled with empty cells, what is too long is cut

  std::optional<std::size_t> column(std::string_view name) const;
};

/// Empty lines count for nothing.
CsvTable parse_csv(std::string_view text);

}  // namespace hyperlattice
