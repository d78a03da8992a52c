// Whether the time steps resolve what the loads do. The mean over a step has the exact impulse, but
// a shape that is as short as a step is lost.
#pragma once

#include <plan/plan.hpp>

namespace hyperlattice {

/// A fault for each load that oscillates faster than half a period a step; a warning in the model
/// for one with fewer than 20 steps a period, or that rises, falls or lasts less than two steps.
void check_resolution(Plan& plan, Faults& faults);

}  // namespace hyperlattice
