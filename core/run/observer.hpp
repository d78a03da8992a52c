// A look at a run from outside while it advances, for programs that steer runs: the Python package.
#pragma once

#include <state/simulation.hpp>

#include <memory>

namespace hyperlattice {

/// Called by the thread that runs the scene. A run without an observer calls nothing. An exception
/// that a member throws ends the run as a failed check does.
class RunObserver {
 public:
  virtual ~RunObserver() = default;

  /// Called once before the first step. The state is that of the start, or of the checkpoint from
  /// which the run continues.
  virtual void begin(Simulation& simulation) = 0;
  /// Called after each step, and after each state of rest that a solver found. `can_change`: new
  /// displacements and velocities may be set now, because the solver keeps no copy of them.
  virtual void advanced(Simulation& simulation, bool can_change) = 0;
  /// Returns whether the run must stop after the present step, as request_stop() stops it.
  virtual bool must_stop() const noexcept = 0;
  /// Gets the state at the end of the run, also of a run that failed. It refers to the plan's
  /// model.
  virtual void keep(std::unique_ptr<Simulation> /*simulation*/) {}
};

}  // namespace hyperlattice
