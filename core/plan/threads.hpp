// How many threads a run takes.
#pragma once

#include <algorithm>
#include <cstdint>

namespace hyperlattice {

class Threads {
 public:
  /// Exactly so many, whatever the body: somebody asked for them.
  Threads(int number)
      : most_(number) {}  // NOLINT(google-explicit-constructor): a number of threads is one
  /// So many, or fewer for a small body.
  static Threads up_to(int most) {
    Threads threads(most);
    threads.exactly_ = false;
    return threads;
  }

  int most() const { return most_; }

  /// The number for a body. A step of `worth_a_thread` particles takes some 40 us. With less work
  /// than that, threads gain less than they cost each other.
  int of(std::uint64_t particles) const {
    constexpr std::uint64_t worth_a_thread = 4096;
    const std::uint64_t busy = std::max<std::uint64_t>(1, particles / worth_a_thread);
    return exactly_ || busy > static_cast<std::uint64_t>(most_) ? most_ : static_cast<int>(busy);
  }
  /// Whether a run may have had this number.
  bool allow(std::int64_t number) const {
    return exactly_ ? number == most_ : number >= 1 && number <= most_;
  }

 private:
  int most_;
  bool exactly_ = true;
};

}  // namespace hyperlattice
