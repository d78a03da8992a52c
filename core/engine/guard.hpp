// Stops a run that goes bad, and says when, where, under which law, and how the time step stood to
// the critical one.
#pragma once

#include <plan/plan.hpp>
#include <state/simulation.hpp>

namespace hyperlattice {

class Guard {
 public:
  Guard(const Model& model, const Simulation& simulation)
      : model_(model), simulation_(simulation) {}

  void start(const PlannedStage& stage) { stage_ = &stage; }
  /// RunError if a number is not finite or a particle runs away. Reads all velocities once.
  void check_motion(double time_step) const;
  /// RunError if an energy is not a number.
  void check_finite(const EnergyBalance& balance, double time_step) const;
  /// RunError if the error of the balance passes the stage's tolerance.
  void check_balance(const EnergyBalance& balance, double time_step) const;

 private:
  [[noreturn]] void fail(const std::string& what, double time_step) const;

  const Model& model_;
  const Simulation& simulation_;
  const PlannedStage* stage_ = nullptr;
};

}  // namespace hyperlattice
