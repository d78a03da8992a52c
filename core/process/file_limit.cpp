#include <process/file_limit.hpp>

namespace hyperlattice {

FileLimitGuard::FileLimitGuard() {
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  sigemptyset(&ignore.sa_mask);
  sigaction(SIGXFSZ, &ignore, &before_);
}

FileLimitGuard::~FileLimitGuard() { sigaction(SIGXFSZ, &before_, nullptr); }

}  // namespace hyperlattice
