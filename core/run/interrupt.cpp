#include <run/interrupt.hpp>
#include <run/run.hpp>

namespace hyperlattice {

namespace {
volatile std::sig_atomic_t stop = 0;
}

void request_stop() noexcept { stop = 1; }
bool stop_requested() noexcept { return stop != 0; }
void forget_stop() noexcept { stop = 0; }

FileLimitGuard::FileLimitGuard() {
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  sigemptyset(&ignore.sa_mask);
  sigaction(SIGXFSZ, &ignore, &before_);
}

FileLimitGuard::~FileLimitGuard() { sigaction(SIGXFSZ, &before_, nullptr); }

}  // namespace hyperlattice
