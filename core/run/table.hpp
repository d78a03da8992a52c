// A CSV file that grows by whole lines: history, probes, failures.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice {

/// Each append is one write; what a full disk cuts off is taken back to the last whole line. Every member throws OutsideError.
class Table {
 public:
  Table(std::filesystem::path file, const std::vector<std::string>& columns);
  Table(Table&& other) noexcept;
  ~Table();

  void row(std::span<const double> values);
  void lines(std::string_view whole_lines);  ///< each ends with a newline

 private:
  [[noreturn]] void fail(int error);

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::string buffer_;
};

/// "a,b,c\n", numbers with all their digits, whatever the locale.
void append_row(std::string& text, std::span<const double> values);

}  // namespace hyperlattice
