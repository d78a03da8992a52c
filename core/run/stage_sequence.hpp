// The solver stages of a run, one after the other.
#pragma once

#include <engine/stage_calls.hpp>
#include <run/checkpoints.hpp>
#include <run/recorder.hpp>
#include <run/run.hpp>

#include <optional>

namespace hyperlattice {

/// Solves the stages of a plan, records them, and saves checkpoints.
class StageSequence {
 public:
  StageSequence(const Plan& plan, const RunOptions& options, RunFolder& folder,
                Simulation& simulation, Ranks& ranks);
  StageSequence(const StageSequence&) = delete;
  StageSequence& operator=(const StageSequence&) = delete;

  /// Saves or restores all that the run needs to continue.
  void archive(Archive& archive);
  /// Begins a new run, or continues from the checkpoint `resumed`. Throws OutsideError if the disk
  /// refuses, and std::runtime_error if the checkpoint does not fit.
  void begin(const std::optional<Checkpoint>& resumed);

  /// Solves the stages until the last one ends, or until must_stop(). Throws RunError if a
  /// solver or a check fails, and OutsideError or std::runtime_error if the disk refuses.
  void solve();
  /// Waits until all frames so far are written. Throws OutsideError if one was not.
  void drain() { recorder_.drain(); }
  /// Ends the outputs.
  void finish() { recorder_.finish(); }

  /// Writes into the outcome what the run has reached, at any time after construction.
  void note(Outcome& outcome);

 private:
  void solve_stage(const PlannedStage& stage);
  bool must_stop();
  void write_motion(const std::vector<double>& motion, const std::vector<double>& heights);

  const Plan& plan_;
  const RunOptions& options_;
  RunFolder& folder_;
  Simulation& simulation_;
  Ranks& ranks_;
  Stopwatch stopwatch_;
  Recorder recorder_;
  Checkpoints checkpoints_;

  const StageCalls* calls_ = nullptr;  ///< of the present stage
  StageMemory memory_;                 ///< of the stage in the middle of which the run continues
  std::uint64_t stages_done_ = 0;      ///< number of completed stages
  std::uint64_t stage_steps_ = 0;      ///< steps, or states of rest, of the present stage
  bool is_resumed_ = false;            ///< the run continues in the middle of a stage
};

}  // namespace hyperlattice
