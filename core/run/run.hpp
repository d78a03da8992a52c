// A run: the planned stages one after the other, with history, probes, writers, progress, summary.
#pragma once

#include <plan/plan.hpp>

#include <filesystem>
#include <string>

namespace hyperlattice {

struct RunOptions {
  std::filesystem::path directory;
  bool quiet = false;      ///< no progress lines
  bool resume = false;     ///< go on from the checkpoint in the folder, with as many threads as the
                           ///< run there began with
  bool overwrite = false;  ///< give up an interrupted run in the folder, and replace files that are
                           ///< not the run's own
  double checkpoint_every = 600;  ///< s between checkpoints; 0: only where the run is interrupted
};

/// Runs a plan. Returns the exit code and leaves summary.json in any case but a failure to write
/// it. Messages go to the log. InputError or OutsideError, with nothing touched, if the folder is
/// not fit for it: another run is writing there, an interrupted one waits to be resumed, what is to
/// be resumed is not there or not as it was, a file that the scene reads would be replaced, or a
/// study is there.
int run(Plan& plan, const RunOptions& options);

/// Asks a running simulation to stop after the present step; safe in a signal handler.
void request_stop() noexcept;

}  // namespace hyperlattice
