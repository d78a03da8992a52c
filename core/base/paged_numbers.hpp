// An array of whole numbers that mostly equal their neighbours, as the materials of particles do.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace hyperlattice {

/// The array in pages. A page whose numbers are all equal takes the memory of one of them. It grows
/// at its end and does not change.
template <class T>
class PagedNumbers {
 public:
  PagedNumbers() = default;
  explicit PagedNumbers(std::span<const T> numbers) {
    for (const T number : numbers) push_back(number);
    numbers_.shrink_to_fit();
  }

  void push_back(T number) {
    if (size_ % page == 0) firsts_.push_back(numbers_.size() << 1 | differ);
    numbers_.push_back(number);
    if (++size_ % page != 0) return;
    const auto first = numbers_.end() - page;
    if (std::adjacent_find(first, numbers_.end(), std::not_equal_to<>()) != numbers_.end()) return;
    numbers_.erase(first + 1, numbers_.end());
    firsts_.back() &= ~differ;
  }
  T operator[](std::size_t index) const {
    const std::size_t first = firsts_[index / page];
    return numbers_[(first >> 1) + ((first & differ) != 0 ? index % page : 0)];
  }
  bool operator==(const PagedNumbers&) const = default;
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  /// Returns the bytes of memory that it takes.
  double bytes() const {
    return static_cast<double>(numbers_.size() * sizeof(T) + firsts_.size() * sizeof(std::size_t));
  }

 private:
  static constexpr std::ptrdiff_t page = 256;  ///< numbers
  static constexpr std::size_t differ = 1;     ///< bit in firsts_

  std::vector<T> numbers_;
  std::vector<std::size_t> firsts_;  ///< of each page: twice its first place in numbers_, and a bit
  std::size_t size_ = 0;
};

}  // namespace hyperlattice
