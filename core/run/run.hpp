// A run: the planned stages in order, with history, probes, writers, progress and summary.
#pragma once

#include <plan/plan.hpp>
#include <ranks/ranks.hpp>

#include <filesystem>
#include <string>

namespace hyperlattice {

class RunObserver;

struct RunOptions {
  std::filesystem::path directory;
  bool quiet = false;  ///< no progress lines
  /// Continues from the folder's checkpoint, with the number of threads of the run there.
  bool resume = false;
  /// Gives up an interrupted run in the folder, and replaces files that are not the run's own.
  bool overwrite = false;
  /// Seconds between checkpoints; 0: only where the run is interrupted.
  double checkpoint_every = 600;
  bool keep_state = false;          ///< leaves the final state, from which other runs can start
  RunObserver* observer = nullptr;  ///< null: none (observer.hpp)
};

/// Runs a plan. Returns the exit code, and leaves summary.json unless writing it fails. Messages go
/// to the log. Throws InputError or OutsideError, and changes nothing, if the folder is unfit:
/// another run is writing there, an interrupted run could be resumed, the run to be resumed is
/// missing or has changed, a file that the scene reads would be replaced, or a study is there.
int run(Plan& plan, const RunOptions& options);
/// Runs a plan together with other ranks, of which the first one writes the folder. All ranks get
/// the same outcome.
int run(Plan& plan, const RunOptions& options, Ranks& ranks);

/// Asks a running simulation to stop after the present step; safe in a signal handler.
void request_stop() noexcept;

}  // namespace hyperlattice
