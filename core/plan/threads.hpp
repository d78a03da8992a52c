// The number of threads of a run.
#pragma once

#include <algorithm>
#include <cstdint>

namespace hyperlattice {

class Threads {
 public:
  /// Exactly this number for any body, because a user asked for it.
  Threads(int number)
      : most_(number) {}  // NOLINT(google-explicit-constructor): a number of threads is one
  /// At most this number; fewer for a small body.
  static Threads up_to(int most) {
    Threads threads(most);
    threads.exactly_ = false;
    return threads;
  }

  int most() const { return most_; }

  /// Returns the number for a body. A step of `worth_a_thread` particles takes about 40 us; with
  /// less work per thread, more threads cost more than they gain.
  int of(std::uint64_t particles) const {
    constexpr std::uint64_t worth_a_thread = 4096;
    const std::uint64_t busy = std::max<std::uint64_t>(1, particles / worth_a_thread);
    return exactly_ || busy > static_cast<std::uint64_t>(most_) ? most_ : static_cast<int>(busy);
  }
  /// Returns whether a run with this setting may have had this number.
  bool allow(std::int64_t number) const {
    return exactly_ ? number == most_ : number >= 1 && number <= most_;
  }

 private:
  int most_;
  bool exactly_ = true;
};

}  // namespace hyperlattice
