// Stops a failing run with a message that has the time, the place, the law, and the ratio of the
// time step to the critical one.
#pragma once

#include <plan/plan.hpp>
#include <state/simulation.hpp>

namespace hyperlattice {

class Guard {
 public:
  Guard(const Model& model, const Simulation& simulation)
      : model_(model), simulation_(simulation) {}

  void start(const PlannedStage& stage) { stage_ = &stage; }
  /// Reads all velocities once. Throws RunError if a number is not finite or a particle runs away.
  void check_motion(double time_step) const;
  /// Throws RunError if an energy is not a number.
  void check_finite(const EnergyBalance& balance, double time_step) const;
  /// Throws RunError if the error of the balance passes the stage's tolerance.
  void check_balance(const EnergyBalance& balance, double time_step) const;

 private:
  [[noreturn]] void fail(const std::string& what, double time_step) const;

  const Model& model_;
  const Simulation& simulation_;
  const PlannedStage* stage_ = nullptr;
};

}  // namespace hyperlattice
