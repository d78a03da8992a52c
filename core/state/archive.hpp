// Saves or restores a state: a function that passes each value to an archive serves both ways.
#pragma once

#include <algorithm>
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
    // Reads in pieces, so that a wrong size takes hardly more memory than the archive has values.
    constexpr std::uint64_t piece = std::max<std::size_t>(1, (1 << 20) / sizeof(T));
    for (std::uint64_t done = 0; done < size; done += piece) {
      const std::uint64_t count = std::min(piece, size - done);
      if (restores_) values.resize(done + count);
      bytes(&values[done], count * sizeof(T));
    }
    if (restores_) values.resize(size);
  }
  template <class T>
  void operator()(std::span<T> values) {
    bytes(values.data(), values.size_bytes());
  }
  /// Reads a value that must equal `value`. Throws std::runtime_error if the archive holds another
  /// one.
  template <class T>
  void same(const T& value, const char* what) {
    T there = value;
    (*this)(there);
    if (there != value)
      throw std::runtime_error(std::string("the checkpoint is of another run: ") + what);
  }

 private:
  void bytes(void* data, std::size_t size) {
    if (size > 0) transfer_(data, size);
  }

  Transfer transfer_;
  bool restores_;
};

}  // namespace hyperlattice
