// Loads that a run never meets: their factor is zero wherever it is looked at.
#pragma once

#include <plan/plan.hpp>

namespace hyperlattice {

/// A warning in the model for each load that does nothing in any stage.
void warn_of_idle_loads(Plan& plan);

}  // namespace hyperlattice
