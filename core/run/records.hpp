// A file of records, each with a tag, a size, its number and a checksum, so that a damaged file is
// known before anything of it is used:
//   "HLRECORD", nonce (8 bytes), then records: tag (4), size of the content (4), number (8),
//   checksum (8), content; the last is "end." without content.
// The nonce is random and enters every checksum, so that a record of another file does not fit.
#pragma once

#include <base/descriptor.hpp>

#include <hyperlattice/files.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice {

/// Writes records. Content longer than a record becomes several records of one tag.
class RecordWriter {
 public:
  explicit RecordWriter(AtomicFile& file);
  /// Throws std::runtime_error if the disk refuses.
  void put(std::string_view tag, const void* data, std::size_t size);
  void end();

 private:
  void flush();

  AtomicFile& file_;
  std::uint64_t nonce_ = 0, number_ = 0;
  std::string tag_;
  std::vector<char> content_;
};

/// Reads contents in the order in which they were written.
class RecordReader {
 public:
  /// Throws std::runtime_error with the reason if any byte of the file is not as it was written.
  static void verify(const std::filesystem::path& file);

  explicit RecordReader(std::filesystem::path file);
  /// Throws std::runtime_error if the next content has another tag or ends before `size` bytes.
  void take(std::string_view tag, void* data, std::size_t size);
  /// Returns the rest of a tag's content.
  std::string take_all(std::string_view tag);

 private:
  /// Reads the next whole record. Returns false at the end.
  bool next();
  void read(void* data, std::size_t size);
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path path_;
  Descriptor file_;
  std::uint64_t nonce_ = 0, number_ = 0;
  std::string tag_;
  std::vector<char> content_;
  std::size_t used_ = 0;
};

}  // namespace hyperlattice
