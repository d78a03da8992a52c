// A stream of random numbers, the same in every run: start vectors of eigenvalue iterations.
#pragma once

#include <cstdint>

namespace hyperlattice::numerics {

/// The linear congruential generator s -> 1664525 s + 1013904223 mod 2^32 of Press et al.,
/// Numerical Recipes (1992), section 7.1; a number is its upper 24 bits. Good enough for start
/// vectors with a part of every eigenvector; random numbers of the physics come from
/// hyperlattice/chance.hpp.
class RandomStream {
 public:
  /// Returns the next number, -0.5 <= x < 0.5.
  double next() {
    state_ = state_ * 1664525u + 1013904223u;
    return static_cast<double>(state_ >> 8) / 16777216.0 - 0.5;
  }

 private:
  std::uint32_t state_ = 12345;
};

}  // namespace hyperlattice::numerics
