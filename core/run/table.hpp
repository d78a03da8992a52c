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

/// How far a file has come: its first bytes and their hash.
struct Extent {
  std::uint64_t bytes = 0;
  std::string hash;
};

/// Each append is one write; what a full disk cuts off is taken back to the last whole line. Every
/// member throws OutsideError.
class Table {
 public:
  /// Begins a table. The file stands under its name only when its header is in it.
  Table(std::filesystem::path file, const std::vector<std::string>& columns);
  /// Goes on with a table that is there, and cuts off what lies beyond `bytes`.
  static Table resumed(std::filesystem::path file, std::uint64_t bytes);
  /// Goes on with a file that is open for appending and holds `bytes` bytes.
  Table(std::filesystem::path file, Descriptor descriptor, std::uint64_t bytes);

  void row(std::span<const double> values);
  void lines(std::string_view whole_lines);  ///< each ends with a newline
  void cut(std::uint64_t bytes);             ///< takes back all but the first bytes
  void sync();                               ///< waits until all lines are on the disk; checks
  void check() const;  ///< that its name still leads to it, and that nobody else wrote into it
  Extent extent() const { return {bytes_, hash_.text()}; }
  const std::filesystem::path& file() const { return file_; }

 private:
  void read(std::uint64_t bytes);
  [[noreturn]] void fail(int error) const;

  std::filesystem::path file_;
  Descriptor descriptor_;
  std::uint64_t bytes_ = 0;
  ContentHash hash_;  ///< of all lines
  std::string buffer_;
};

/// Whether a regular file begins with these bytes.
bool has_extent(const std::filesystem::path& file, const Extent& extent);

/// "a,b,c\n", numbers with all their digits, whatever the locale.
void append_row(std::string& text, std::span<const double> values);

}  // namespace hyperlattice
