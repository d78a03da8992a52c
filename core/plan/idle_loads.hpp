// Finds loads that a run never meets: their factor is zero at all instants that are tried.
#pragma once

#include <plan/plan.hpp>

namespace hyperlattice {

/// Adds a warning to the model for each load that does nothing in any stage.
void warn_of_idle_loads(Plan& plan);

}  // namespace hyperlattice
