// What a run does without, and why.
#pragma once

#include <plan/plan.hpp>

namespace hyperlattice {

/// Needs the plan's scene, model and stages.
std::vector<LeftOut> left_out(const Plan& plan);

}  // namespace hyperlattice
