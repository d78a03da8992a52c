// The system's limit on the size of files (ulimit -f).
#pragma once

#include <csignal>

namespace hyperlattice {

/// Ignores SIGXFSZ while it exists: a write past the limit fails with an error instead of ending
/// the program.
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
