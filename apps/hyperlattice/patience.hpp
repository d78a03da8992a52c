// Progress messages while a large body is planned.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

namespace hyperlattice {

/// Prints the elapsed time on standard error every few seconds during its life, from its own
/// thread. Short work prints nothing.
class Patience {
 public:
  Patience();
  ~Patience();
  Patience(const Patience&) = delete;
  Patience& operator=(const Patience&) = delete;

 private:
  void watch() noexcept;

  std::mutex mutex_;
  std::condition_variable ended_;
  bool over_ = false;
  std::thread thread_;
};

}  // namespace hyperlattice
