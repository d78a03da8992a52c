// A run: the planned stages one after the other, with history, probes, writers, progress, summary.
#pragma once

#include <plan/plan.hpp>

#include <filesystem>
#include <string>

namespace hyperlattice {

struct RunOptions {
  std::filesystem::path directory;
  bool quiet = false;             ///< no progress lines
  bool resume = false;            ///< go on from the checkpoint in the folder
  double checkpoint_every = 600;  ///< s between checkpoints; 0: only where the run is interrupted
};

/// Runs a plan. Returns the exit code and leaves summary.json in any case but a failure to write it. Messages go to the log.
int run(Plan& plan, const RunOptions& options);

/// Makes ready a plan for going on in a folder, with as many threads as the run there began with. InputError if it cannot.
void prepare_to_resume(Plan& plan, const std::filesystem::path& directory);

/// Asks a running simulation to stop after the present step; safe in a signal handler.
void request_stop() noexcept;

}  // namespace hyperlattice
