// Errors inside parallel loops, which no exception may leave.
#pragma once

#include <cstddef>
#include <exception>
#include <mutex>
#include <utility>

namespace hyperlattice {

/// Keeps the exceptions of the parts of a parallel loop. After the loop, rethrow() throws the one
/// of the lowest part, so the result does not depend on the number of threads.
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
  /// Returns whether a part failed. Call it only after the loop or its barrier.
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
