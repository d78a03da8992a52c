// Tables as text (CSV): the first line names the columns, see CsvReader. The SDK's
// <hyperlattice/tables.hpp> cuts lines into cells.
#pragma once

#include <hyperlattice/tables.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice {

/// Returns the cells of a single line, for example of a table's first line.
std::vector<std::string> csv_cells(std::string_view line);

/// Returns the number in a cell; nothing if the cell holds no number or one that is not finite.
std::optional<double> csv_number(std::string_view cell);

/// Reads the rows of a table, one after the other. The first line that is neither blank nor begins
/// with "#" names the columns. If this line holds a number, it is a row, and the columns are named
/// by the last line above it that begins with "#" and has as many cells, otherwise by the last line
/// above it that begins with "#". All other lines that begin with "#" are skipped. Lines end with
/// LF, CR or both.
class CsvReader {
 public:
  /// Reads the names of the columns. The text must outlive the reader.
  explicit CsvReader(std::string_view text);

  /// Returns the names of the columns; none if the text has no line that names them.
  const std::vector<std::string>& columns() const { return names_; }
  /// Returns these names for a message, see TableColumns.
  std::string columns_text() const { return columns_.text(); }
  /// Returns the number of the line that names the columns, from 1.
  std::size_t columns_line() const { return columns_line_; }

  /// Goes to the next row. Returns false at the end.
  bool next();
  /// Returns the cells of the row, which may be more or fewer than columns.
  const std::vector<std::string>& cells() const { return cells_; }
  /// Returns the number of the row's line in the text, from 1.
  std::size_t line() const { return line_; }
  /// Returns what was expected if the row has a wrong number of cells; empty if it is right.
  /// Columns without a name at the end need no cell.
  std::string fault() const;

 private:
  std::string_view rest_;
  TableColumns columns_;
  std::vector<std::string> names_;
  std::size_t columns_line_ = 0, line_ = 0;
  std::vector<std::string> cells_;
};

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

/// Reads a whole table.
CsvTable parse_csv(std::string_view text);

}  // namespace hyperlattice
