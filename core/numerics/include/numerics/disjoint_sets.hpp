// Connected components of a graph: union by the smallest number, with path halving (Tarjan and van
// Leeuwen 1984).
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace hyperlattice::numerics {

/// Sets of the numbers 0 <= n < size; at first each number is its own set.
class DisjointSets {
 public:
  explicit DisjointSets(std::int64_t size) : root_(static_cast<std::size_t>(size)) {
    std::iota(root_.begin(), root_.end(), 0);
  }
  /// Returns the smallest number of the set that contains `number`.
  std::int64_t root(std::int64_t number) {
    while (at(number) != number) number = at(number) = at(at(number));
    return number;
  }
  void join(std::int64_t a, std::int64_t b) {
    a = root(a);
    b = root(b);
    at(std::max(a, b)) = std::min(a, b);
  }

 private:
  std::int64_t& at(std::int64_t number) { return root_[static_cast<std::size_t>(number)]; }
  std::vector<std::int64_t> root_;
};

}  // namespace hyperlattice::numerics
