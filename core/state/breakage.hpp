// The failure of one spring.
#pragma once

#include <hyperlattice/plain.hpp>

#include <cstdint>

namespace hyperlattice {

/// The failure of one base spring. Its cross springs fail with it.
struct Breakage {
  std::uint64_t step = 0;
  double time = 0;        ///< s
  Particle a = 0, b = 0;  ///< a precedes b in the order z, y, x
  std::uint32_t neighbour = 0;
  double elongation = 0;  ///< at the failure, m
  /// false: a criterion removed the spring; true: its law softened until its integrity was 0, and
  /// the spring stays, because a closed crack may push
  bool softened = false;
  /// A criterion removed a spring that had softened before: the spring counts once.
  bool again = false;
};

}  // namespace hyperlattice
