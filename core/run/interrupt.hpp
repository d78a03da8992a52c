// A request from outside to stop a run.
#pragma once

namespace hyperlattice {

/// Returns whether request_stop() (run.hpp) was called since the last forget_stop().
bool stop_requested() noexcept;
void forget_stop() noexcept;

}  // namespace hyperlattice
