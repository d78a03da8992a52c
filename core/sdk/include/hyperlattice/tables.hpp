// Tables in text files: lines of cells; the first line names the columns. Accepts what spreadsheets
// and programs write: a byte order mark, cells in quotation marks, commas, semicolons, tabs or
// blanks between cells, blank lines, comments, "+" before numbers, "#" before the names.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice {

/// Returns the number in a cell, with a decimal point; nothing if the cell has no number or one
/// that is not finite.
inline std::optional<double> table_number(std::string_view cell) {
  if (cell.size() > 1 && cell.front() == '+' && cell[1] != '-') cell.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(number))
    return std::nullopt;
  return number;
}

/// Returns the index of the column with that name, or else of one that differs only in capital
/// letters.
inline std::optional<std::size_t> find_column(std::span<const std::string> columns,
                                              std::string_view name) {
  const auto lower = [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  };
  const auto alike = [&](char a, char b) { return lower(a) == lower(b); };
  for (const bool exactly : {true, false})
    for (std::size_t n = 0; n < columns.size(); ++n)
      if (exactly
              ? columns[n] == name
              : std::equal(name.begin(), name.end(), columns[n].begin(), columns[n].end(), alike))
        return n;
  return std::nullopt;
}

/// Returns whether a name fits several columns: two have this name, or none has it and two differ
/// from it only in capital letters.
inline bool is_ambiguous_column(std::span<const std::string> columns, std::string_view name) {
  const auto found = find_column(columns, name);
  if (!found) return false;
  const auto others = columns.subspan(*found + 1);
  return columns[*found] == name ? std::find(others.begin(), others.end(), name) != others.end()
                                 : find_column(others, name).has_value();
}

/// Returns whether `column` is probably a misspelled `meant`: letters are wrong or swapped (one, in
/// a long name two), its end is missing, or a unit follows it.
inline bool is_nearly_column(std::string_view column, std::string_view meant) {
  column = column.substr(0, std::min(column.find_first_of(" ([", 1), column.size()));
  const auto letter = [](std::string_view text, std::size_t n) {
    return text[n] >= 'A' && text[n] <= 'Z' ? static_cast<char>(text[n] - 'A' + 'a') : text[n];
  };
  const std::size_t most = meant.size() < 8 ? 1 : 2, fewest_letters = 3;
  if (column.size() < fewest_letters || column.size() > meant.size() + most) return false;
  std::vector<std::size_t> before, above(meant.size() + 1),
      row(meant.size() + 1);  // edit distances between the beginnings of both names
  for (std::size_t j = 0; j <= meant.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= column.size(); ++i) {
    before = std::move(above);
    above = row;
    row[0] = i;
    for (std::size_t j = 1; j <= meant.size(); ++j) {
      const bool same = letter(column, i - 1) == letter(meant, j - 1);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (same ? 0u : 1u)});
      if (i > 1 && j > 1 && letter(column, i - 1) == letter(meant, j - 2) &&
          letter(column, i - 2) == letter(meant, j - 1))
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[meant.size()] <= most || row[std::min(column.size(), meant.size())] == 0;
}

/// Returns the beginning of a cell for a message, with control characters as "U+0000".
inline std::string shown_cell(std::string_view cell, std::size_t most = 40) {
  constexpr char digits[] = "0123456789ABCDEF";
  std::string shown;
  for (const char c : cell.substr(0, most)) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code == 0x7F)
      shown += {'U', '+', '0', '0', digits[code / 16], digits[code % 16]};
    else
      shown += c;
  }
  return shown;
}

/// Returns why a file that begins with these bytes cannot be read as a table; empty if it may be
/// one.
inline std::string table_encoding_fault(std::string_view bytes) {
  return bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")
             ? "it is a text in UTF-16: save it in ASCII or UTF-8"
             : "";
}

/// The lines of a text file. They end with LF, CR or both.
class TableLines {
 public:
  explicit TableLines(std::istream& in) : in_(in) {}

  bool next(std::string& line) {
    if (at_ > read_.size()) {
      if (!std::getline(in_, read_)) return false;
      if (read_.ends_with('\r')) read_.pop_back();
      at_ = 0;
    }
    const std::size_t end = std::min(read_.find('\r', at_), read_.size());
    line.assign(read_, at_, end - at_);
    at_ = end + 1;
    return true;
  }

 private:
  std::istream& in_;
  std::string read_;
  std::size_t at_ = 1;
};

/// The columns of a table, and the separator of its cells: the first of tab, semicolon, comma and
/// blank that the first line contains.
class TableColumns {
 public:
  explicit TableColumns(std::string_view first_line) {
    first_line = without_mark(first_line);
    if (is_comment(first_line)) first_line = trimmed(trimmed(first_line).substr(1));
    for (const char candidate : {'\t', ';', ',', ' '})
      if (trimmed(first_line).find(candidate) != std::string_view::npos) {
        separator_ = candidate;
        break;
      }
    names_ = cells(first_line);
  }

  const std::vector<std::string>& names() const { return names_; }

  std::optional<std::size_t> find(std::string_view name) const { return find_column(names_, name); }

  /// Returns the number of columns, without columns at the end that have no name.
  std::size_t count() const {
    std::size_t count = names_.size();
    while (count > 0 && names_[count - 1].empty()) --count;
    return count;
  }

  /// Returns an error text if a row has more cells than there are columns; else empty. Empty cells
  /// at the end do not count.
  std::string excess(std::span<const std::string> cells) const {
    const std::size_t most = count();
    std::size_t given = cells.size();
    while (given > most && cells[given - 1].empty()) --given;
    if (given <= most) return "";
    return "a row of at most " + std::to_string(most) + (most == 1 ? " cell" : " cells") +
           ", one a column, not of " + std::to_string(given) +
           (separator_ == ',' ? " (decimal commas? numbers have a decimal point)" : "");
  }

  bool has_all(std::span<const std::string_view> names) const {
    return std::all_of(names.begin(), names.end(),
                       [&](std::string_view name) { return find(name).has_value(); });
  }

  /// Returns the cells of a line, without surrounding blanks and quotation marks.
  std::vector<std::string> cells(std::string_view line) const {
    std::vector<std::string> found;
    if (separator_ == '\t')
      line = line.substr(0, std::min(line.find('\r'),
                                     line.size()));  // a tab borders an empty cell
    else
      line = trimmed(line);
    for (bool more = true; more;) {
      std::string cell;
      more = take_cell(line, cell);
      found.push_back(std::move(cell));
    }
    return found;
  }

  static bool is_blank(std::string_view line) { return trimmed(without_mark(line)).empty(); }
  /// Returns whether a line begins with "#". Such a line may still name the columns if no row is
  /// above it.
  static bool is_comment(std::string_view line) {
    return trimmed(without_mark(line)).starts_with('#');
  }
  /// Returns whether a line below the names has no cells.
  static bool is_empty(std::string_view line) { return is_blank(line) || is_comment(line); }

  /// Returns the column names for a message: "x", "y", "z"; shortened if there are many.
  std::string text() const {
    constexpr std::size_t most = 200;
    std::string all;
    for (const std::string& name : names_) {
      all += (all.empty() ? "\"" : ", \"") + shown_cell(name, most) + '"';
      if (all.size() > most) return all + ", ...";
    }
    return all;
  }

 private:
  static constexpr std::string_view blank_ = " \t\r\v\f";
  /// Returns the line without a byte order mark at its beginning.
  static std::string_view without_mark(std::string_view line) {
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    return line.starts_with(mark) ? line.substr(mark.size()) : line;
  }
  static std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(blank_);
    return first == std::string_view::npos
               ? std::string_view()
               : text.substr(first, text.find_last_not_of(blank_) - first + 1);
  }
  /// Moves the first cell of the line to `cell`. Returns whether there is another cell.
  bool take_cell(std::string_view& line, std::string& cell) const {
    const auto after_blanks = [&] {
      line.remove_prefix(
          std::min(line.find_first_not_of(separator_ == '\t' ? " " : " \t"), line.size()));
    };
    after_blanks();
    if (line.starts_with('"')) {
      line.remove_prefix(1);
      for (; !line.empty(); line.remove_prefix(1)) {
        if (line.front() != '"') {
          cell += line.front();
        } else if (line.substr(1).starts_with('"')) {  // two marks stand for one
          cell += '"';
          line.remove_prefix(1);
        } else {
          line.remove_prefix(1);
          break;
        }
      }
    }
    const std::size_t end = std::min(line.find(separator_), line.size());
    cell += trimmed(line.substr(0, end));
    const bool more = end < line.size();
    line.remove_prefix(more ? end + 1 : end);
    return more;
  }

  char separator_ = ',';
  std::vector<std::string> names_;
};

/// Columns of numbers, read from a table file: one vector for each requested column, in the
/// requested order; an optional column that is missing is empty. The first line that is neither
/// blank nor a comment names the columns; if it does not name all required columns, but a comment
/// above it does, that comment names them. Throws std::invalid_argument, with the file, the first
/// wrong lines and the expected values, if rows cannot be read, if a column's name nearly equals
/// that of an optional one, or if the file cannot be read to its end.
class NumberTable {
 public:
  NumberTable(const std::string& file, std::span<const std::string_view> required,
              std::span<const std::string_view> optional = {})
      : file_(file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::invalid_argument("file " + file + " cannot be read");
    check_encoding(in);
    TableLines lines(in);
    std::string line;
    std::size_t number = 0, header_number = 0;  // 0: the file has no line that is not blank
    TableColumns header("");
    bool is_named = false, is_row = false;  // whether `header` has all required columns, and
                                            // whether `line` is a row below a comment that has them
    for (bool is_comment = true; is_comment && lines.next(line);) {
      ++number;
      if (TableColumns::is_blank(line)) continue;
      const TableColumns columns(line);
      const bool has_all = columns.has_all(required);
      is_comment = TableColumns::is_comment(line);
      is_row = !is_comment && is_named && !has_all;
      if (is_named && !has_all) continue;
      header = columns;
      header_number = number;
      is_named = has_all;
    }
    check_reading(in);
    if (header_number == 0 && !required.empty()) complain(1, "a table: the file is empty");
    for (const std::string_view name : required) {
      if (!header.find(name))
        complain(header_number, "a column \"" + std::string(name) +
                                    "\", named in the first line; it names " + header.text());
      take_column(name, header, header_number);
    }
    for (const std::string_view name : optional) {
      take_column(name, header, header_number);
      if (!columns_.back().place) refuse_nearly(name, header, header_number, required, optional);
    }
    if (is_row) read_line(header, line, number);
    while (lines.next(line)) {
      ++number;
      if (!TableColumns::is_empty(line)) read_line(header, line, number);
    }
    check_reading(in);
    if (bad_rows_ > most_shown)
      complaints_ += "; and " + std::to_string(bad_rows_ - most_shown) + " such lines more";
    if (bad_rows_ > 0) throw std::invalid_argument("file " + file_ + complaints_);
  }

  /// Returns a requested column.
  const std::vector<double>& operator[](std::string_view name) const {
    for (const Column& column : columns_)
      if (column.name == name) return column.numbers;
    throw std::invalid_argument("no column \"" + std::string(name) + "\" was asked for");
  }

  /// Returns the line of the file, from 1, that holds a row.
  std::size_t line(std::size_t row) const { return lines_[row]; }

  /// Throws std::invalid_argument with the file, the row's line and the expected value.
  [[noreturn]] void refuse(std::size_t row, const std::string& expected) const {
    complain(lines_[row], expected);
  }

 private:
  static constexpr std::size_t most_shown = 5;  // wrong lines that a message shows

  struct Column {
    std::string_view name;
    std::optional<std::size_t> place;
    std::vector<double> numbers;
  };

  void check_encoding(std::ifstream& in) const {
    std::array<char, 2> mark{};
    in.read(mark.data(), mark.size());
    const std::string fault =
        table_encoding_fault({mark.data(), static_cast<std::size_t>(in.gcount())});
    if (!fault.empty()) throw std::invalid_argument("file " + file_ + " cannot be read: " + fault);
    check_reading(in);
    in.clear();
    in.seekg(0);
  }
  void check_reading(const std::ifstream& in) const {
    if (in.bad()) throw std::invalid_argument("file " + file_ + " cannot be read to its end");
  }
  static std::string complaint(std::size_t line, const std::string& expected) {
    return "line " + std::to_string(line) + ": expected " + expected;
  }
  [[noreturn]] void complain(std::size_t line, const std::string& expected) const {
    throw std::invalid_argument("file " + file_ + ", " + complaint(line, expected));
  }
  void take_column(std::string_view name, const TableColumns& header, std::size_t line) {
    if (is_ambiguous_column(header.names(), name))
      complain(line,
               "one column \"" + std::string(name) + "\", not several; it names " + header.text());
    columns_.push_back({name, header.find(name), {}});
  }
  void refuse_nearly(std::string_view name, const TableColumns& header, std::size_t line,
                     std::span<const std::string_view> required,
                     std::span<const std::string_view> optional) const {
    for (const std::string& column : header.names()) {
      const auto is_it = [&column](std::string_view asked) {
        return find_column({&column, 1}, asked).has_value();
      };
      if (std::any_of(required.begin(), required.end(), is_it) ||
          std::any_of(optional.begin(), optional.end(), is_it))
        continue;
      if (is_nearly_column(column, name))
        complain(line, "the name \"" + std::string(name) + "\" for column \"" + shown_cell(column) +
                           "\", or one that is less like it");
    }
  }
  void read_line(const TableColumns& header, const std::string& line, std::size_t number) {
    const std::vector<std::string> cells = header.cells(line);
    const std::string fault = read_cells(header, cells);
    if (!fault.empty() && ++bad_rows_ <= most_shown)
      complaints_ += (complaints_.empty() ? ", " : "; ") + complaint(number, fault);
    lines_.push_back(number);
  }
  /// Reads a row. Returns the expected value if the row cannot be read; empty if it was read.
  std::string read_cells(const TableColumns& header, const std::vector<std::string>& cells) {
    if (std::string excess = header.excess(cells); !excess.empty()) return excess;
    for (Column& column : columns_) {
      if (!column.place) continue;
      const std::string cell = *column.place < cells.size() ? cells[*column.place] : "";
      const auto value = table_number(cell);
      if (!value)
        return "a number in column \"" + std::string(column.name) + "\", not \"" +
               shown_cell(cell) + "\"" +
               (cell.find(',') == std::string::npos ? "" : "; numbers have a decimal point");
      column.numbers.push_back(*value);
    }
    return "";
  }

  std::string file_, complaints_;
  std::size_t bad_rows_ = 0;
  std::vector<Column> columns_;
  std::vector<std::size_t> lines_;  // line of each row in the file
};

}  // namespace hyperlattice
