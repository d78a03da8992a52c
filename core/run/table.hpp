// A CSV file that grows by whole lines: history, probes, failures.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice {

class Archive;

/// Each append is one write; what a full disk cuts off is taken back to the last whole line. Every member throws OutsideError.
class Table {
 public:
  Table(std::filesystem::path file, const std::vector<std::string>& columns);
  Table(Table&& other) noexcept;
  ~Table();

  void row(std::span<const double> values);
  void save(Archive& archive);  ///< how far it has come
  /// Goes on with a table that is there, from where it had come.
  static Table resumed(std::filesystem::path file, Archive& archive);
  void lines(std::string_view whole_lines);  ///< each ends with a newline

 private:
  explicit Table(std::filesystem::path file) : file_(std::move(file)) {}
  std::uint64_t bytes() const;
  [[noreturn]] void fail(int error);

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::string buffer_;
};

/// "a,b,c\n", numbers with all their digits, whatever the locale.
void append_row(std::string& text, std::span<const double> values);

}  // namespace hyperlattice
