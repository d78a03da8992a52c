// Arrays of the state: memory aligned to cache lines, and numbers in the precision of the run.
#pragma once

#include <hyperlattice/array_memory.hpp>
#include <hyperlattice/material.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>

namespace hyperlattice {

/// Zeros in memory aligned to cache lines. The thread that makes the array writes it first, so that
/// the memory is local to that thread.
/// Says that an array is filled later: until then its numbers mean nothing, and the system gives
/// memory only to what is written.
struct FilledLater {};

template <class T>
class AlignedArray {
 public:
  AlignedArray() = default;
  AlignedArray(std::size_t size, FilledLater)
      : data_(static_cast<T*>(allocate_array(size * sizeof(T))), Free{size}), size_(size) {}
  explicit AlignedArray(std::size_t size)
      : data_(static_cast<T*>(allocate_array(size * sizeof(T))), Free{size}), size_(size) {
    std::uninitialized_fill_n(data_.get(), size, T{});
  }
  T* get() const { return data_.get(); }
  std::size_t size() const { return size_; }
  T& operator[](std::size_t n) const { return data_.get()[n]; }

 private:
  struct Free {
    std::size_t size = 0;
    void operator()(T* data) const { free_array(data, size * sizeof(T)); }
  };
  std::unique_ptr<T, Free> data_;
  std::size_t size_ = 0;
};

/// Numbers stored as doubles or floats, read and written as doubles. Code for whole arrays is in
/// kernels, which are compiled for each precision.
class Numbers {
 public:
  Numbers() = default;
  Numbers(Precision precision, std::size_t size) {
    if (precision == Precision::floats)
      floats_ = AlignedArray<float>(size);
    else
      doubles_ = AlignedArray<double>(size);
  }
  Numbers(Precision precision, std::size_t size, FilledLater later) {
    if (precision == Precision::floats)
      floats_ = AlignedArray<float>(size, later);
    else
      doubles_ = AlignedArray<double>(size, later);
  }
  void* get() const {
    return floats_.get() != nullptr ? static_cast<void*>(floats_.get()) : doubles_.get();
  }
  double operator[](std::size_t n) const {
    return floats_.get() != nullptr ? double{floats_[n]} : doubles_[n];
  }
  void set(std::size_t n, double value) const {
    if (floats_.get() != nullptr)
      floats_[n] = static_cast<float>(value);
    else
      doubles_[n] = value;
  }
  bool empty() const { return get() == nullptr; }
  std::span<std::byte> bytes() const {
    return floats_.get() != nullptr
               ? std::as_writable_bytes(std::span(floats_.get(), floats_.size()))
               : std::as_writable_bytes(std::span(doubles_.get(), doubles_.size()));
  }
  /// Copies `count` numbers of another array of this precision.
  void copy(const Numbers& from, std::size_t first, std::size_t count, std::size_t to) const {
    if (floats_.get() != nullptr)
      std::copy_n(from.floats_.get() + first, count, floats_.get() + to);
    else
      std::copy_n(from.doubles_.get() + first, count, doubles_.get() + to);
  }
  void clear() const {
    std::fill_n(floats_.get(), floats_.size(), 0.0F);
    std::fill_n(doubles_.get(), doubles_.size(), 0.0);
  }

 private:
  AlignedArray<double> doubles_;  // one of the two is empty
  AlignedArray<float> floats_;
};

}  // namespace hyperlattice
