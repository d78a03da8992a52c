// Errors inside parallel regions, which no exception may leave.
#pragma once

#include <cstddef>
#include <exception>
#include <mutex>
#include <utility>

namespace hyperlattice {

/// Keeps what the parts of a parallel loop throw. The exception of the part that comes first goes
/// on after the loop, whatever the number of threads.
class ThreadErrors {
 public:
  template <class Code>
  void run(std::size_t part, Code&& code) noexcept {
    try {
      code();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!thrown_ || part < part_) {
        thrown_ = std::current_exception();
        part_ = part;
      }
    }
  }
  /// Only after the loop, or behind its barrier.
  bool any() const { return thrown_ != nullptr; }
  void rethrow() {
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  }

 private:
  std::mutex mutex_;
  std::exception_ptr thrown_;
  std::size_t part_ = 0;
};

}  // namespace hyperlattice
