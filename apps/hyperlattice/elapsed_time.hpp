// Progress messages while a large body is planned.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

namespace hyperlattice {

/// Prints the elapsed time on standard error every few seconds during its life, from its own
/// thread. Short work prints nothing.
class ElapsedTime {
 public:
  ElapsedTime();
  ~ElapsedTime();
  ElapsedTime(const ElapsedTime&) = delete;
  ElapsedTime& operator=(const ElapsedTime&) = delete;

 private:
  void watch() noexcept;

  std::mutex mutex_;
  std::condition_variable ended_;
  bool over_ = false;
  std::thread thread_;
};

}  // namespace hyperlattice
