#include <run/interrupt.hpp>
#include <run/observer.hpp>
#include <run/run.hpp>

#include <csignal>

namespace hyperlattice {

namespace {
volatile std::sig_atomic_t stop = 0;
}

void request_stop() noexcept { stop = 1; }
bool stop_requested() noexcept { return stop != 0; }
bool must_stop(const RunOptions& options) noexcept {
  return stop_requested() || (options.observer != nullptr && options.observer->must_stop());
}
void forget_stop() noexcept { stop = 0; }

}  // namespace hyperlattice
