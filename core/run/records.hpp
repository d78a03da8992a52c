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

/// Writes records; a long content becomes several records of one tag.
class RecordWriter {
 public:
  explicit RecordWriter(AtomicFile& file);
  void put(std::string_view tag, const void* data,
           std::size_t size);  ///< std::runtime_error if the disk refuses
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
  /// Throws std::runtime_error with what is wrong, if any byte of the file is not what was written.
  static void verify(const std::filesystem::path& file);

  explicit RecordReader(std::filesystem::path file);
  void take(std::string_view tag, void* data,
            std::size_t size);                 ///< std::runtime_error if there is no such content
  std::string take_all(std::string_view tag);  ///< all that is left of a tag's content

 private:
  bool next();  ///< reads the next record whole; false at the end
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
