// Stops a failing run with a message that has the time, the place, the law, the ratio of the time
// step to the critical one, and the likely cause.
#pragma once

#include <plan/plan.hpp>
#include <state/simulation.hpp>

namespace hyperlattice {

class Guard {
 public:
  Guard(const Model& model, const Simulation& simulation);

  void start(const PlannedStage& stage) {
    stage_ = &stage;
    has_warned_ = false;
  }
  /// Reads all velocities once. Throws RunError if a number is not finite or a particle runs away.
  void check_motion(double time_step) const;
  /// Throws RunError if ends of a spring approach too fast for the step (the stage's
  /// `approach_limit`). Reads the springs only where particles are fast enough for it.
  void check_approach(double time_step) const;
  /// Returns the likely cause if the error of the balance has passed a tenth of the stage's
  /// tolerance, once in a stage; empty otherwise.
  std::string early_warning(const EnergyBalance& balance, double time_step);
  /// Throws RunError if an energy is not a number.
  void check_finite(const EnergyBalance& balance, double time_step) const;
  /// Throws RunError if the error of the balance passes the stage's tolerance.
  void check_balance(const EnergyBalance& balance, double time_step) const;

 private:
  /// Returns the critical time step of the stage at rest, s.
  double critical() const;
  [[noreturn]] void fail(const std::string& what, double time_step) const;

  const Model& model_;
  const Simulation& simulation_;
  const PlannedStage* stage_ = nullptr;
  double shortest_;  ///< rest length of a spring, m
  bool has_warned_ = false;
};

}  // namespace hyperlattice
