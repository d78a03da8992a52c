// Stops a failing run with a message that has the time, the place, the law, the ratio of the time
// step to the critical one, and the likely cause.
#pragma once

#include <engine/energy_growth.hpp>
#include <engine/momentum_watch.hpp>
#include <plan/plan.hpp>
#include <state/simulation.hpp>

namespace hyperlattice {

class Guard {
 public:
  Guard(const Model& model, const Simulation& simulation);

  /// Turns to a stage. `is_resumed`: the run continues in the middle of it.
  void start(const PlannedStage& stage, bool is_resumed);
  /// Saves or restores what checks take over from earlier records of the stage.
  void archive(Archive& archive);
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
  /// Throws RunError if energy grows beyond all that was put in (the stage's `growth_limit`). Of
  /// each record once. `work`: of each load, J.
  void check_growth(const EnergyBalance& balance, const std::vector<double>& work,
                    double time_step);
  /// Throws RunError if the momentum is not what the loads explain (the stage's
  /// `momentum_tolerance`). Of each record once.
  void check_momentum(const EnergyBalance& balance, double time_step);
  /// Returns a warning if the time step is longer than the present critical one, as springs stiffen
  /// or are stretched, once in a stage; empty otherwise. Reads all springs, in about the time of a
  /// hundred steps, so that it looks rarely: see guard.cpp. `balance`: of a record.
  std::string step_warning(const EnergyBalance& balance, double time_step);
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
  /// What warnings take over from earlier records. A plain record: part of the checkpoint.
  struct Warned {
    std::uint64_t of_error = 0, of_step = 0;  ///< 1: the warning was given in this stage
    std::uint64_t looked = 0;  ///< step of the last look at the present critical step
    double error_looked = 0;   ///< relative error of the balance then
  };
  Warned warned_;
  EnergyGrowth growth_;
  MomentumWatch momentum_;
};

}  // namespace hyperlattice
