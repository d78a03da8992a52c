// Numbers in pages, of which a page of equal numbers takes little memory.
#include <base/paged_numbers.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

namespace paged_numbers_test {
using namespace hyperlattice;

/// Numbers that are 3, but `different` of them, at any place, are others.
std::vector<std::uint8_t> mostly_alike(std::size_t size, std::size_t different) {
  std::vector<std::uint8_t> numbers(size, 3);
  std::mt19937_64 random(1);
  for (std::size_t n = 0; n < different; ++n)
    numbers[random() % size] = static_cast<std::uint8_t>(random());
  return numbers;
}

TEST(PagedNumbers, HoldTheNumbersInTheirOrder) {
  for (const std::size_t size : {1U, 255U, 256U, 257U, 5000U})
    for (const std::size_t different : {0U, 3U, 5000U}) {
      const std::vector<std::uint8_t> numbers = mostly_alike(size, different);
      const PagedNumbers<std::uint8_t> paged(numbers);
      ASSERT_EQ(paged.size(), size);
      for (std::size_t n = 0; n < size; ++n) ASSERT_EQ(paged[n], numbers[n]) << size << ", " << n;
      EXPECT_TRUE(paged == PagedNumbers<std::uint8_t>(numbers));
    }
  EXPECT_TRUE(PagedNumbers<std::uint8_t>().empty());
}

TEST(PagedNumbers, EqualNumbersTakeNoMemoryEach) {
  constexpr std::size_t size = 1 << 20;
  EXPECT_LT(PagedNumbers<std::uint8_t>(mostly_alike(size, 0)).bytes(), 0.05 * size);
  EXPECT_LT(PagedNumbers<std::uint8_t>(mostly_alike(size, size)).bytes(), 1.05 * size);
}

}  // namespace paged_numbers_test
