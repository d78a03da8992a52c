// A stream of random numbers, the same in every run: starts of iterations that find eigenvalues.
#pragma once

#include <cstdint>

namespace hyperlattice::numerics {

/// The linear congruential generator s -> 1664525 s + 1013904223 mod 2^32 of Press et al.,
/// Numerical Recipes (1992), section 7.1. Its upper 24 bits are the number. Good enough to meet
/// every eigenvector; numbers that physics needs come from hyperlattice/chance.hpp.
class RandomStream {
 public:
  /// The next number, -0.5 <= x < 0.5.
  double next() {
    state_ = state_ * 1664525u + 1013904223u;
    return static_cast<double>(state_ >> 8) / 16777216.0 - 0.5;
  }

 private:
  std::uint32_t state_ = 12345;
};

}  // namespace hyperlattice::numerics
