// States of simulations, and of other things that pass an archive, in memory.
#pragma once

#include <state/archive.hpp>

#include <cstring>
#include <vector>

namespace hyperlattice::test {

/// Saves a state in memory.
template <class Kept>
std::vector<char> saved(Kept& kept) {
  std::vector<char> bytes;
  Archive archive(
      [&](void* data, std::size_t size) {
        const char* from = static_cast<const char*>(data);
        bytes.insert(bytes.end(), from, from + size);
      },
      false);
  kept.archive(archive);
  return bytes;
}

/// Restores it. Returns the number of bytes that it read.
template <class Kept>
std::size_t restore(Kept& kept, const std::vector<char>& bytes) {
  std::size_t at = 0;
  Archive archive(
      [&](void* data, std::size_t size) {
        std::memcpy(data, bytes.data() + at, size);
        at += size;
      },
      true);
  kept.archive(archive);
  return at;
}

}  // namespace hyperlattice::test
