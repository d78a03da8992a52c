// A run: the planned stages one after the other, with history, probes, writers, progress, summary.
#pragma once

#include <plan/plan.hpp>

#include <filesystem>
#include <string>

namespace hyperlattice {

struct RunOptions {
  std::filesystem::path directory;
  bool quiet = false;  ///< no progress lines
};

/// Runs a plan. Returns the exit code and leaves summary.json in any case but a failure to write it. Messages go to the log.
int run(Plan& plan, const RunOptions& options);

/// Asks a running simulation to stop after the present step; safe in a signal handler.
void request_stop() noexcept;

}  // namespace hyperlattice
