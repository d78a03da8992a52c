// Arrays of the state: memory aligned to cache lines, and numbers in the precision of the run.
#pragma once

#include <hyperlattice/array_memory.hpp>
#include <hyperlattice/material.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

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
  /// Makes arrays of `size` numbers at a distance of `stride` in one piece of memory. The first
  /// array owns it. `at_once`: they are zeros; otherwise they are filled later.
  static void allocate_together(std::size_t size, std::size_t stride,
                                std::span<AlignedArray* const> arrays, bool at_once) {
    const std::size_t all = stride * (arrays.size() - 1) + size;
    *arrays[0] = at_once ? AlignedArray(all) : AlignedArray(all, FilledLater());
    arrays[0]->size_ = size;
    T* const first = arrays[0]->get();
    for (std::size_t n = 1; n < arrays.size(); ++n) {
      arrays[n]->data_ = {first + n * stride, Free{0, false}};
      arrays[n]->size_ = size;
    }
  }
  T* get() const { return data_.get(); }
  std::size_t size() const { return size_; }
  T& operator[](std::size_t n) const { return data_.get()[n]; }

 private:
  struct Free {
    std::size_t size = 0;
    bool owns = true;
    void operator()(T* data) const {
      if (owns) free_array(data, size * sizeof(T));
    }
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
  /// Makes arrays of one size, one behind the other in one piece of memory, each aligned to cache
  /// lines. Returns the distance of their first numbers. The first array owns the memory.
  /// `at_once`: they are zeros; otherwise they are filled later.
  static std::size_t allocate_together(Precision precision, std::size_t size,
                                       std::span<Numbers> arrays, bool at_once) {
    const std::size_t line = cache_line / bytes_of(precision),
                      stride = (size + line - 1) / line * line;
    const auto allocate = [&]<class T>(AlignedArray<T> Numbers::*member) {
      std::vector<AlignedArray<T>*> parts;
      for (Numbers& one : arrays) parts.push_back(&(one.*member));
      AlignedArray<T>::allocate_together(size, stride, parts, at_once);
    };
    if (precision == Precision::floats)
      allocate(&Numbers::floats_);
    else
      allocate(&Numbers::doubles_);
    return stride;
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
