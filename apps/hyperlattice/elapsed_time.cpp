#include "elapsed_time.hpp"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <system_error>

namespace hyperlattice {

ElapsedTime::ElapsedTime() {
  try {
    thread_ = std::thread([this] { watch(); });
  } catch (const std::system_error&) {  // no thread, no messages
  }
}

ElapsedTime::~ElapsedTime() {
  {
    const std::scoped_lock lock(mutex_);
    over_ = true;
  }
  ended_.notify_all();
  if (thread_.joinable()) thread_.join();
}

/// Allocates no memory, since the planned work may be near the memory limit.
void ElapsedTime::watch() noexcept {
  constexpr int every = 5;  // s
  std::unique_lock lock(mutex_);
  for (int seconds = every;
       !ended_.wait_for(lock, std::chrono::seconds(every), [this] { return over_; });
       seconds += every) {
    char line[80];
    const int length =
        std::snprintf(line, sizeof line, "hyperlattice: planning the body, %d s so far\n", seconds);
    [[maybe_unused]] const auto written =
        ::write(STDERR_FILENO, line, static_cast<std::size_t>(length));
  }
}

}  // namespace hyperlattice
