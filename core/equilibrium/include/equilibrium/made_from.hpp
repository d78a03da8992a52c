// What a preconditioner was made from, as numbers that a checkpoint holds: a run that is resumed
// makes the same preconditioner again. Arrays of floats are stored in pairs, bit by bit.
#pragma once

#include <equilibrium/numerics.hpp>

#include <cstring>
#include <span>
#include <stdexcept>
#include <vector>

namespace hyperlattice::equilibrium {

/// Adds numbers to those that a checkpoint will hold.
class MadeFromWriter {
 public:
  explicit MadeFromWriter(std::vector<double>& to) : to_(to) { to_.clear(); }

  void operator()(double number) { to_.push_back(number); }
  template <class Array>
  void operator()(const Array& numbers) {
    if (numbers.empty()) return;
    const std::size_t bytes = numbers.size() * sizeof(numbers[0]), first = to_.size();
    to_.resize(first + (bytes + sizeof(double) - 1) / sizeof(double));
    std::memcpy(to_.data() + first, numbers.data(), bytes);
  }

 private:
  std::vector<double>& to_;
};

/// Reads them in the same order into arrays that have their sizes already. Throws
/// std::runtime_error if there are too few.
class MadeFromReader {
 public:
  explicit MadeFromReader(std::span<const double> from) : from_(from) {}

  void operator()(double& number) { number = take(1).front(); }
  template <class Array>
  void operator()(Array& numbers) {
    if (numbers.empty()) return;
    const std::size_t bytes = numbers.size() * sizeof(numbers[0]);
    std::memcpy(numbers.data(), take((bytes + sizeof(double) - 1) / sizeof(double)).data(), bytes);
  }

 private:
  std::span<const double> take(std::size_t count) {
    if (from_.size() < count) throw std::runtime_error("the checkpoint is of another body");
    const std::span<const double> taken = from_.first(count);
    from_ = from_.subspan(count);
    return taken;
  }

  std::span<const double> from_;
};

}  // namespace hyperlattice::equilibrium
