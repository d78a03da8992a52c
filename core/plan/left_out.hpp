// The features that a run does not compute, and why.
#pragma once

#include <plan/plan.hpp>

namespace hyperlattice {

/// Returns these features; needs the plan's scene, model and stages.
std::vector<LeftOut> left_out(const Plan& plan);

}  // namespace hyperlattice
