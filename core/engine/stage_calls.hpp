// The functions that a solver calls during its stage. The solver is in a plugin: an exception
// thrown inside these functions is kept until the solver has returned (plugin_call.hpp).
#pragma once

#include <plan/plan.hpp>
#include <state/simulation.hpp>
#include <statics/statics.hpp>

#include <exception>
#include <functional>
#include <memory>

namespace hyperlattice {

/// What a stage that goes on in its middle needs besides the simulation's state.
struct StageMemory {
  std::vector<double> solver;   ///< what the solver kept, see SolverHost::keep()
  std::vector<double> statics;  ///< see Statics::memory()
};

class StageCalls {
 public:
  /// Further actions when a solver calls; each may be empty.
  struct Hooks {
    std::function<void(double time_step)> stepped;
    std::function<void()> rested;  ///< after each state of rest that the solver found
    /// After `stepped` or `rested`. `can_change`: the solver keeps no copy of the state, so that
    /// another one may be set.
    std::function<void(bool can_change)> advanced;
    std::function<void()> observe;
    std::function<void(const RestReport&)> report;
    /// Three numbers per particle, and one height per particle in free membranes.
    std::function<void(const std::vector<double>& motion, const std::vector<double>& heights)>
        failing_motion;
    std::function<bool()> must_stop;
  };
  StageCalls(const Model& model, Simulation& simulation, const PlannedStage& stage, int threads,
             Hooks hooks, std::uint64_t steps_done = 0, StageMemory memory = {});
  StageCalls(const StageCalls&) = delete;
  StageCalls& operator=(const StageCalls&) = delete;

  /// Runs the stage. Throws RunError if the solver fails, or the exception that was thrown inside
  /// the solver's calls.
  void run();
  /// Returns what a run that is resumed at the present state needs.
  StageMemory memory() const;

 private:
  template <class Code>
  bool guarded(Code&& code) noexcept;
  /// Returns the body for solvers, made at the first call.
  Statics& statics(Statics::Search search = Statics::Search::rest);
  void meet_end(double time_step);

  const Model& model_;
  Simulation& simulation_;
  const PlannedStage& stage_;
  int threads_;
  Hooks hooks_;
  SolverHost host_;
  std::unique_ptr<Statics> statics_;
  StageMemory resumed_;       ///< what the run that is resumed left
  std::vector<double> kept_;  ///< by the solver
};

/// Runs a stage that looks for rest outside of a run, without history and outputs. Throws RunError
/// if it fails.
RestReport bring_to_rest(const Plan& plan, Simulation& simulation);

}  // namespace hyperlattice
