// The record of a run: what is checked, written and shown while its solvers advance the state.
#pragma once

#include <engine/guard.hpp>
#include <run/failure_log.hpp>
#include <run/history.hpp>
#include <run/outputs.hpp>
#include <run/progress.hpp>
#include <run/stopwatch.hpp>
#include <run/summary.hpp>
#include <state/inside_out.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hyperlattice {

/// Its members throw RunError if a check stops the run, and OutsideError if a writer, a probe or
/// the disk refuses.
class Recorder {
 public:
  Recorder(const Plan& plan, Simulation& simulation, RunFolder& folder, Stopwatch& stopwatch,
           Ranks& ranks);
  /// Saves or restores all but the state of the simulation.
  void archive(Archive& archive);
  /// Begins the files that grow, or continues them. `quiet`: shows no progress.
  void begin(bool quiet);

  /// Turns to a stage. `is_resumed`: the run continues in the middle of it.
  void start_stage(const PlannedStage& stage, bool is_resumed);
  /// Checks the motion after a step; not after every one.
  void take_step(double time_step);
  /// Keeps the latest report of a solver that looks for rest.
  void take_report(const RestReport& report) { rest_ = report; }
  /// Records the present state, and shows it to the outputs that are due.
  void observe();
  /// Returns whether the motion of the present state passes the checks. Checkpoints are due by the
  /// clock: the checks that stop a run do not depend on them.
  bool is_sound() const;
  /// Observes the state if that was not done since the last step.
  void observe_once();
  /// Records the state at the end of the stage. At rest all outputs are due.
  void end_stage();
  /// Waits until all frames so far are written.
  void drain();
  /// Shows the last state to outputs, and ends them.
  void finish();

  /// Writes into the outcome what was recorded, whether or not the run has ended.
  void note(Outcome& outcome);

 private:
  /// Steps between checks. A check reads the velocities once, a fraction of a step's work.
  static constexpr std::uint64_t guard_every = 50;

  template <class Check>
  void guarded(const Check& check);
  void record();
  void look_at_cells();

  Simulation& simulation_;
  Stopwatch& stopwatch_;
  Guard guard_;
  CellWatch cells_;
  History history_;
  std::optional<FailureLog> failures_;
  Outputs outputs_;
  std::unique_ptr<Progress> progress_;
  std::uint64_t planned_steps_, first_step_;

  const PlannedStage* stage_ = nullptr;
  Schedule schedule_;               ///< of the records in this stage
  double time_step_ = 0;            ///< the latest, s
  std::uint64_t observed_ = 0;      ///< number of steps at the last observation
  std::optional<RestReport> rest_;  ///< latest report of a solver
  std::vector<std::string> warnings_;
};

}  // namespace hyperlattice
