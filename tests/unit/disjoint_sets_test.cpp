// Sets that several threads join at the same time are those of one thread.
#include <numerics/disjoint_sets.hpp>
#include <numerics/shared_disjoint_sets.hpp>

#include <gtest/gtest.h>

#include <random>
#include <thread>
#include <utility>
#include <vector>

namespace disjoint_sets_test {
using namespace hyperlattice::numerics;

TEST(SharedDisjointSets, AreThoseOfOneThread) {
  constexpr std::uint64_t size = 20000;
  std::mt19937 random(7);
  std::vector<std::pair<std::uint64_t, std::uint64_t>> pairs;
  // Chains and a few long joins: deep trees, and many sets.
  for (std::uint64_t n = 0; n + 1 < size; ++n)
    if (random() % 3 != 0) pairs.emplace_back(n + 1, n);
  for (int n = 0; n < 2000; ++n) pairs.emplace_back(random() % size, random() % size);
  DisjointSets expected(static_cast<std::int64_t>(size));
  for (const auto& pair : pairs)
    expected.join(static_cast<std::int64_t>(pair.first), static_cast<std::int64_t>(pair.second));
  for (int repeat = 0; repeat < 20; ++repeat) {
    SharedDisjointSets sets(size);
    std::vector<std::thread> threads;
    for (std::size_t part = 0; part < 4; ++part)
      threads.emplace_back([&sets, &pairs, part] {
        for (std::size_t n = part; n < pairs.size(); n += 4)
          sets.join(pairs[n].first, pairs[n].second);
      });
    for (std::thread& thread : threads) thread.join();
    for (std::uint64_t n = 0; n < size; ++n)
      ASSERT_EQ(sets.root(n),
                static_cast<std::uint64_t>(expected.root(static_cast<std::int64_t>(n))));
  }
}

}  // namespace disjoint_sets_test
