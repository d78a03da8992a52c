// A limit on the size of files.
#pragma once

#include <csignal>

namespace hyperlattice {

/// While it lives, a write past the limit on the size of files is an error of the write, and not
/// the end of the program.
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
