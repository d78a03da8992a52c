// Tables as text (CSV): the first line names the columns, see parse_csv(). The SDK's
// <hyperlattice/tables.hpp> cuts lines into cells.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice {

/// Returns the cells of a single line, for example of a table's first line.
std::vector<std::string> csv_cells(std::string_view line);

/// Returns the number in a cell; nothing if the cell holds no number or one that is not finite.
std::optional<double> csv_number(std::string_view cell);

/// A row with a wrong number of cells.
struct CsvFault {
  std::size_t line = 0;  ///< number of the line, from 1
  std::string expected;  ///< what was expected in this line
};

/// A table: names of columns and rows of cells.
struct CsvTable {
  std::vector<std::string> columns;
  /// cells of each row, as many as columns; short rows are filled with empty cells, long rows are
  /// cut
  std::vector<std::vector<std::string>> rows;
  std::vector<std::size_t> lines;  ///< line number of each row in the text, from 1
  /// the first rows with more or fewer cells than columns, at most 5
  std::vector<CsvFault> faults;

  /// Returns the index of the column with this name, otherwise of one whose name differs in capital
  /// letters only.
  std::optional<std::size_t> column(std::string_view name) const;
};

/// Returns the first name that several columns have; nothing if all names differ. Columns without a
/// name do not count.
std::optional<std::string> name_of_several(const CsvTable& table);

/// Reads a table. The first line that is neither blank nor begins with "#" names the columns. If
/// this line holds a number, it is a row, and the columns are named by the last line above it that
/// begins with "#" and has as many cells, otherwise by the last line above it that begins with "#".
/// All other lines that begin with "#" are skipped. Lines end with LF, CR or both.
CsvTable parse_csv(std::string_view text);

}  // namespace hyperlattice
