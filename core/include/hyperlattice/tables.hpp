// Tables of numbers in files: comma-separated, the first line names the columns.
#pragma once

#include <charconv>
#include <cmath>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice {

/// The columns asked for, one vector each in their order; a missing one that may be missing is empty. Throws std::invalid_argument with the file, the
/// line and what was expected there.
class NumberTable {
 public:
  NumberTable(const std::string& file, std::span<const std::string_view> required, std::span<const std::string_view> optional = {}) : file_(file) {
    std::ifstream in(file);
    if (!in) throw std::invalid_argument("file " + file + " cannot be read");
    std::string line;
    std::getline(in, line);
    const std::vector<std::string> header = cells_of(line);
    for (const std::string_view name : required) {
      columns_.emplace_back(name, place_of(header, name));
      if (columns_.back().place == missing) complain(1, "a column \"" + std::string(name) + "\", named in the first line");
    }
    for (const std::string_view name : optional) columns_.emplace_back(name, place_of(header, name));
    for (std::size_t number = 2; std::getline(in, line); ++number)
      if (!line.empty() && line != "\r") read_line(line, number);
  }

  /// Of a column that was asked for.
  const std::vector<double>& operator[](std::string_view name) const {
    for (const Column& column : columns_)
      if (column.name == name) return column.numbers;
    throw std::invalid_argument("no column \"" + std::string(name) + "\" was asked for");
  }

 private:
  static constexpr std::size_t missing = ~std::size_t{0};
  struct Column {
    Column(std::string_view n, std::size_t p) : name(n), place(p) {}
    std::string_view name;
    std::size_t place;
    std::vector<double> numbers;
  };

  static std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells(1);
    for (const char c : line)
      if (c == ',')
        cells.emplace_back();
      else if (c != '\r' && c != ' ' && c != '\t')
        cells.back() += c;
    return cells;
  }
  static std::size_t place_of(const std::vector<std::string>& header, std::string_view name) {
    for (std::size_t n = 0; n < header.size(); ++n)
      if (header[n] == name) return n;
    return missing;
  }
  [[noreturn]] void complain(std::size_t line, const std::string& expected) const {
    throw std::invalid_argument("file " + file_ + ", line " + std::to_string(line) + ": expected " + expected);
  }
  void read_line(const std::string& line, std::size_t number) {
    const std::vector<std::string> cells = cells_of(line);
    for (Column& column : columns_) {
      if (column.place == missing) continue;
      const std::string cell = column.place < cells.size() ? cells[column.place] : "";
      double value = 0;
      const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
      if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
        complain(number, "a number in column \"" + std::string(column.name) + "\", not \"" + cell + "\"");
      column.numbers.push_back(value);
    }
  }

  std::string file_;
  std::vector<Column> columns_;
};

}  // namespace hyperlattice
