// A request from outside to stop a run.
#pragma once

namespace hyperlattice {

/// Whether request_stop() (run.hpp) was called and not yet forgotten.
bool stop_requested() noexcept;
void forget_stop() noexcept;

}  // namespace hyperlattice
