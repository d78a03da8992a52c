// A CSV file that grows by whole lines: history, probes, failures, the list of the run's files.
#pragma once

#include <base/content_hash.hpp>
#include <base/descriptor.hpp>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice {

/// The first bytes of a file: their number and their hash.
struct Extent {
  std::uint64_t bytes = 0;
  std::string hash;
};

/// Appends by one write each. If the disk is full, the table is cut back to the last whole line.
/// All members throw OutsideError.
class Table {
 public:
  /// Begins a table. The file appears under its name only when it has its header.
  Table(std::filesystem::path file, const std::vector<std::string>& columns);
  /// Continues an existing table, and cuts off all beyond `bytes`.
  static Table resumed(std::filesystem::path file, std::uint64_t bytes);
  /// Continues a file that is open for appending and holds `bytes` bytes.
  Table(std::filesystem::path file, Descriptor descriptor, std::uint64_t bytes);

  /// Returns a table that keeps nothing: of a rank that does not write.
  static Table nowhere() { return {}; }

  void row(std::span<const double> values);
  void lines(std::string_view whole_lines);  ///< each ends with a newline
  void cut(std::uint64_t bytes);             ///< removes all but the first bytes
  /// Waits until all lines are on the disk, then checks.
  void sync();
  /// Throws if the name no longer leads to this file, or if another program wrote into it.
  void check() const;
  Extent extent() const { return {bytes_, hash_.text()}; }
  const std::filesystem::path& file() const { return file_; }

 private:
  Table() = default;
  void read(std::uint64_t bytes);
  [[noreturn]] void fail(int error) const;

  std::filesystem::path file_;
  Descriptor descriptor_;
  std::uint64_t bytes_ = 0;
  ContentHash hash_;  ///< of all lines
  std::string buffer_;
};

/// Returns whether a regular file begins with these bytes.
bool has_extent(const std::filesystem::path& file, const Extent& extent);

/// Appends a line "a,b,c\n" with all digits of the numbers, whatever the locale.
void append_row(std::string& text, std::span<const double> values);

}  // namespace hyperlattice
