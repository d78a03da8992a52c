// Tables as text: the first line names the columns, see parse_csv. How lines are cut into cells is
// the SDK's <hyperlattice/tables.hpp>.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice {

/// The cells of a line that stands alone, such as a table's first.
std::vector<std::string> csv_cells(std::string_view line);

/// The cell's number; nothing if it is none, or not finite.
std::optional<double> csv_number(std::string_view cell);

struct CsvFault {
  std::size_t line = 0;  ///< from 1
  std::string expected;  ///< there
};

struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< each as long as the columns; short lines are
                                               ///< filled with empty cells, what is too long is cut
  std::vector<std::size_t> lines;              ///< of each row, where it stands in the text, from 1
  std::vector<CsvFault>
      faults;  ///< the first few rows that have more or fewer cells than there are columns

  /// The place of a column of that name, or else of one that differs in capital letters only.
  std::optional<std::size_t> column(std::string_view name) const;
};

/// The first name that several columns have; nothing if there is none. Columns without a name do
/// not count.
std::optional<std::string> name_of_several(const CsvTable& table);

/// The first line that is neither blank nor begins with "#" names the columns. If this line holds a
/// number, it is a row instead, and the last line above it that begins with "#" and has as many
/// cells, or else the last such line, names the columns. All other lines that begin with "#" are
/// skipped. Lines end with LF, CR or both.
CsvTable parse_csv(std::string_view text);

}  // namespace hyperlattice
