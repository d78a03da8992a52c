// The energy balance of a simulation, checked at every step.
#pragma once

#include <state/simulation.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hyperlattice::test {

struct WorstBalance {
  double largest_error = 0;  ///< largest relative error of the balance at any step
  EnergyBalance last;
};

/// Runs 4 us in equal steps, each about `fraction` of the critical time step.
inline WorstBalance worst_balance(const Model& model, double fraction, double damping = 0) {
  Simulation simulation(model, 2);
  simulation.set_damping(damping);
  const int steps = static_cast<int>(std::ceil(4e-6 / (fraction * model.step_limit.time_step)));
  WorstBalance balance;
  simulation.balance();
  for (int n = 0; n < steps; ++n) {
    simulation.step(4e-6 / steps);
    balance.last = simulation.balance();
    balance.largest_error =
        std::max(balance.largest_error, std::abs(balance.last.relative_error()));
  }
  EXPECT_GT(balance.last.scale, 0);
  return balance;
}

}  // namespace hyperlattice::test
