// What a solver calls while its stage runs. The solver is a plugin's: an exception thrown below it
// waits until its call has returned (plugin_call.hpp).
#pragma once

#include <plan/plan.hpp>
#include <state/simulation.hpp>
#include <statics/statics.hpp>

#include <exception>
#include <functional>
#include <memory>

namespace hyperlattice {

class StageCalls {
 public:
  /// What else is to be done when a solver calls; each may be empty.
  struct Hooks {
    std::function<void(double time_step)> stepped;
    std::function<void()> observe;
    std::function<void(const RestReport&)> report;
    /// Three numbers a particle, and one of the height where membranes can move.
    std::function<void(const std::vector<double>& motion, const std::vector<double>& heights)>
        failing_motion;
    std::function<bool()> must_stop;
  };
  StageCalls(const Model& model, Simulation& simulation, const PlannedStage& stage, int threads,
             Hooks hooks, std::uint64_t steps_done = 0);
  StageCalls(const StageCalls&) = delete;
  StageCalls& operator=(const StageCalls&) = delete;

  /// Runs the stage. RunError if the solver fails; what was thrown inside its calls, if anything
  /// was.
  void run();

 private:
  template <class Code>
  bool guarded(Code&& code) noexcept;
  Statics& statics();  ///< built when first asked for
  void meet_end(double time_step);

  const Model& model_;
  Simulation& simulation_;
  const PlannedStage& stage_;
  int threads_;
  Hooks hooks_;
  SolverHost host_;
  std::unique_ptr<Statics> statics_;
};

/// Runs a stage that looks for rest, outside of a run: no history, no outputs. RunError if it
/// fails.
RestReport bring_to_rest(const Plan& plan, Simulation& simulation);

}  // namespace hyperlattice
