// The run time of a plan, measured by a few steps of the run on this machine.
#pragma once

#include <plan/plan.hpp>

namespace hyperlattice {

/// Replaces the expected run time by a measured one: from steps of the body at rest during a
/// quarter of a second, and from the trial frames of its writers. A plan whose state is too large
/// for such a trial keeps its time, which comes from a table.
void calibrate_run_time(Plan& plan);

}  // namespace hyperlattice
