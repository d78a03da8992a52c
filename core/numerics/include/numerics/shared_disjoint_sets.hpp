// Connected components of a graph whose edges several threads add at the same time: union by the
// smallest number, without locks (Anderson and Woll 1991).
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace hyperlattice::numerics {

/// Sets of the numbers 0 <= n < size; at first each number is its own set. Any thread may call any
/// member at any time. The sets and their roots do not depend on the order of the calls.
class SharedDisjointSets {
 public:
  explicit SharedDisjointSets(std::size_t size) : parent_(size) {
    for (std::size_t n = 0; n < size; ++n) parent_[n].store(n, std::memory_order_relaxed);
  }

  /// Returns the smallest number of the set that contains `number`, once no thread joins any more.
  std::uint64_t root(std::uint64_t number) {
    for (;;) {
      const std::uint64_t parent = at(number);
      if (parent == number) return number;
      // A number that has a parent never becomes a root again, so that any ancestor may be its
      // parent.
      const std::uint64_t above = at(parent);
      parent_[number].store(above, std::memory_order_relaxed);
      number = above;
    }
  }

  void join(std::uint64_t a, std::uint64_t b) {
    for (;;) {
      a = root(a);
      b = root(b);
      if (a == b) return;
      if (a < b) std::swap(a, b);
      std::uint64_t expected = a;
      if (parent_[a].compare_exchange_strong(expected, b, std::memory_order_relaxed)) return;
    }
  }

 private:
  std::uint64_t at(std::uint64_t number) const {
    return parent_[number].load(std::memory_order_relaxed);
  }

  std::vector<std::atomic<std::uint64_t>> parent_;
};

}  // namespace hyperlattice::numerics
