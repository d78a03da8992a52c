// Checks whether the time steps resolve the loads. The mean of a factor over a step keeps the exact
// impulse, but a shape as short as a step is lost.
#pragma once

#include <plan/plan.hpp>

namespace hyperlattice {

/// Adds a fault for each load with fewer than two steps per period, and a warning to the model for
/// each load with fewer than 20 steps per period, or that rises, falls or lasts less than two
/// steps.
void check_resolution(Plan& plan, Faults& faults);

}  // namespace hyperlattice
