// The account of a body's energy since the start of its balance.
#pragma once

#include <state/block_set.hpp>
#include <state/clock.hpp>
#include <state/energy_balance.hpp>
#include <state/failure_record.hpp>
#include <state/sweeps.hpp>

#include <vector>

namespace hyperlattice {

class EnergyAccount {
 public:
  EnergyAccount(const BlockSet& blocks, const Clock& clock, const FailureRecord& failures,
                Sweeps& sweeps)
      : blocks_(blocks), clock_(clock), failures_(failures), sweeps_(sweeps) {}

  /// Returns the balance of the present state. Throws RunError if a load is not a number.
  EnergyBalance balance();
  /// Returns the work of each load up to the present state, J.
  std::vector<double> injected_by_load();
  /// Returns the work of each load in the last balance, J.
  const std::vector<double>& work() const { return work_; }

  /// Finds the energy and the potential of the state at the start of the balance, if they are not
  /// known.
  void find_start();
  /// Lets the balance start at the next state that is measured.
  void forget_start() {
    start_known_ = false;
    count_intervention();
  }
  /// Counts that motion was set, stopped or damped from outside of the loads.
  void count_intervention() { ++interventions_; }
  /// Adds to the energy at the start, J.
  void shift_start(double added) { start_energy_ += added; }
  /// Sets the present error of the balance to zero.
  void clear_error() { start_energy_ += balance().error; }

  /// Counts energy, J, that was dissipated where motion was stopped or an equilibrium applied.
  void count_halted(double energy) { halted_energy_ += energy; }
  /// Counts energy, J, that was lost in softening during an equilibrium update.
  void count_softened(double energy) { softened_energy_ += energy; }
  /// Counts work, J, that body accelerations would have done in addition, had they acted in full
  /// during an equilibrium update.
  void count_unused_gravity(double work) { unused_gravity_ += work; }

  void archive(Archive& archive);

 private:
  /// Returns the sums of the present state, with what was counted outside of rows.
  RowSums measure();

  const BlockSet& blocks_;
  const Clock& clock_;
  const FailureRecord& failures_;
  Sweeps& sweeps_;

  double softened_energy_ = 0, halted_energy_ = 0, unused_gravity_ = 0;  // J
  bool start_known_ = false;
  std::uint64_t interventions_ = 0;
  double start_energy_ = 0, start_potential_ = 0, largest_energy_ = 0;  // J
  std::vector<double> work_;  // of each load in the last balance, J
};

}  // namespace hyperlattice
