// The energy balance. The energy of the scheme, 1/2 v(n-1/2).M.v(n+1/2) plus the stored energy at
// n, changes only by the work of loads and by dissipation in damping and failure. All of these are
// counted over the same half steps, so that the balance closes to round-off for small strains and
// to the square of the step otherwise.
//
// A measurement at n ends the step's kick half-way, with the mean of the loads over the half step
// before n. Velocity and momentum are then those at n, with the exact impulse of the loads up to n,
// and no load is asked for a time after n. The error does not depend on this choice: another force
// would add to the kinetic energy its work over the same half step.
#include <state/energy_account.hpp>
#include <state/load_work.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

RowSums EnergyAccount::measure() {
  RowSums total = sweeps_.measure(Sweep::present(clock_.last_step()));
  total.damped += halted_energy_;
  total.fractured += softened_energy_;
  total.potential -= unused_gravity_;
  return total;
}

void EnergyAccount::find_start() {
  if (start_known_) return;
  start_known_ = true;
  const RowSums sums = measure();
  start_potential_ = sums.potential;
  start_energy_ = sums.kinetic + sums.stored + sums.damped + sums.fractured + failures_.energy();
  for (const double work : work_by_load(blocks_, 0, clock_.last_step())) start_energy_ -= work;
}

std::vector<double> EnergyAccount::injected_by_load() {
  const RowSums sums = measure();
  return work_by_load(blocks_, sums.potential - start_potential_, clock_.last_step());
}

EnergyBalance EnergyAccount::balance() {
  find_start();
  const RowSums sums = measure();
  sweeps_.check_loads();
  EnergyBalance balance;
  balance.kinetic = sums.kinetic;
  balance.kinetic_mean = sums.kinetic_mean;
  balance.stored = sums.stored;
  balance.momentum = sums.momentum;
  balance.dissipated_damping = sums.damped;
  balance.dissipated_failure = failures_.energy() + sums.fractured;
  const double potential = sums.potential - start_potential_;
  work_ = work_by_load(blocks_, potential, clock_.last_step());
  for (const double work : work_) balance.injected += work;
  balance.error =
      balance.kinetic + balance.stored + balance.dissipated() - balance.injected - start_energy_;
  largest_energy_ =
      std::max({largest_energy_, std::abs(balance.kinetic) + std::abs(balance.stored),
                std::abs(balance.dissipated_failure), std::abs(balance.dissipated_damping),
                std::abs(balance.injected), gross_work(blocks_, potential, clock_.last_step()),
                std::abs(start_energy_)});
  balance.scale = largest_energy_;
  balance.interventions = interventions_;
  return balance;
}

void EnergyAccount::archive(Archive& archive) {
  archive(softened_energy_);
  archive(halted_energy_);
  archive(unused_gravity_);
  archive(start_known_);
  archive(start_energy_);
  archive(start_potential_);
  archive(largest_energy_);
  archive(interventions_);
}

}  // namespace hyperlattice
