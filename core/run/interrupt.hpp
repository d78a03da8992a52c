// A request from outside to stop a run.
#pragma once

namespace hyperlattice {

struct RunOptions;

/// Returns whether request_stop() (run.hpp) was called since the last forget_stop().
bool stop_requested() noexcept;
/// Returns whether the present run must stop: stop_requested(), or its observer says so.
bool must_stop(const RunOptions& options) noexcept;
void forget_stop() noexcept;

}  // namespace hyperlattice
