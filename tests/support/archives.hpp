// States of simulations in memory.
#pragma once

#include <state/archive.hpp>
#include <state/simulation.hpp>

#include <cstring>
#include <vector>

namespace hyperlattice::test {

/// Saves a state in memory.
inline std::vector<char> saved(Simulation& simulation) {
  std::vector<char> bytes;
  Archive archive(
      [&](void* data, std::size_t size) {
        const char* from = static_cast<const char*>(data);
        bytes.insert(bytes.end(), from, from + size);
      },
      false);
  simulation.archive(archive);
  return bytes;
}

/// Restores it. Returns the number of bytes that it read.
inline std::size_t restore(Simulation& simulation, const std::vector<char>& bytes) {
  std::size_t at = 0;
  Archive archive(
      [&](void* data, std::size_t size) {
        std::memcpy(data, bytes.data() + at, size);
        at += size;
      },
      true);
  simulation.archive(archive);
  return at;
}

}  // namespace hyperlattice::test
