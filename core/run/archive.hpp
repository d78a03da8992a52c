// One description of a state for both ways: what visits an archive is saved in it, or restored from it.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace hyperlattice {

class Archive {
 public:
  /// Moves bytes into the file or out of it; throws if it cannot.
  using Transfer = std::function<void(void* data, std::size_t size)>;
  Archive(Transfer transfer, bool restores) : transfer_(std::move(transfer)), restores_(restores) {}

  bool restores() const { return restores_; }

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(T& value) { bytes(&value, sizeof value); }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(std::vector<T>& values) {
    std::uint64_t size = values.size();
    (*this)(size);
    values.resize(size);
    bytes(values.data(), size * sizeof(T));
  }
  template <class T>
  void operator()(std::span<T> values) {
    bytes(values.data(), values.size_bytes());
  }
  /// Of what is never another: std::runtime_error if it is.
  template <class T>
  void same(const T& value, const char* what) {
    T there = value;
    (*this)(there);
    if (there != value) throw std::runtime_error(std::string("the checkpoint is of another run: ") + what);
  }

  std::uint64_t sum() const { return sum_; }  ///< of all bytes so far

 private:
  void bytes(void* data, std::size_t size);

  Transfer transfer_;
  bool restores_;
  std::uint64_t sum_ = 0;
};

}  // namespace hyperlattice
