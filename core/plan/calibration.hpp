// The run time of a plan, from a few steps of the run itself on the machine that plans.
#pragma once

#include <plan/plan.hpp>

namespace hyperlattice {

/// Replaces the expected run time by one from steps of the body at rest, a quarter of a second of
/// them, and from the frames that its writers wrote in trial. A plan whose state is too large to be
/// made in passing keeps its time, from a table.
void calibrate_run_time(Plan& plan);

}  // namespace hyperlattice
