// Content hashes: files or texts with equal hashes are taken as equal.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace hyperlattice {

/// The 128-bit XXH3 hash of bytes that are added in pieces.
class ContentHash {
 public:
  ContentHash();
  void add(std::string_view bytes);
  std::string text() const;  ///< hash of all bytes so far, 32 hexadecimal digits

 private:
  struct State;
  std::shared_ptr<State> state_;  ///< shared by copies
};

/// Returns the hash of a text, 32 hexadecimal digits.
std::string hash_of_text(std::string_view text);

/// Returns the hash of a file, which it reads in pieces. Throws OutsideError if the file cannot be
/// read.
std::string hash_of_file(const std::filesystem::path& file);

}  // namespace hyperlattice
