// Hashes of contents: two files or texts of the same hash are the same.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace hyperlattice {

/// The 128-bit XXH3 hash of bytes that come piece by piece.
class ContentHash {
 public:
  ContentHash();
  void add(std::string_view bytes);
  std::string text() const;  ///< 32 hexadecimal digits, of all bytes so far

 private:
  struct State;
  std::shared_ptr<State> state_;  ///< copies go on together
};

std::string hash_of_text(std::string_view text);

/// Reads the file piece by piece. OutsideError if it cannot be read.
std::string hash_of_file(const std::filesystem::path& file);

}  // namespace hyperlattice
