// What may cut a run short from outside: a request to stop, a limit on the size of files.
#pragma once

#include <csignal>

namespace hyperlattice {

/// Whether request_stop() (run.hpp) was called and not yet forgotten.
bool stop_requested() noexcept;
void forget_stop() noexcept;

/// While it lives, a write past the limit on the size of files is an error of the write, and not the end of the program.
class FileLimitGuard {
 public:
  FileLimitGuard();
  ~FileLimitGuard();
  FileLimitGuard(const FileLimitGuard&) = delete;
  FileLimitGuard& operator=(const FileLimitGuard&) = delete;

 private:
  struct sigaction before_ {};
};

}  // namespace hyperlattice
