// A sign of life while a large body is planned.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

namespace hyperlattice {

/// While it lives, a line on standard error every few seconds says how long it has been. Short work
/// says nothing.
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
