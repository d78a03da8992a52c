// Checks whether floats are precise enough for a scene. A displacement u is rounded by about u /
// 2^24, and so are elongations. The error of the strain of a spring as long as the lattice constant
// l is u / (2^24 l), wherever the body has moved far from its start.
#pragma once

#include <plan/plan.hpp>

namespace hyperlattice {

/// Returns a warning if floats are too coarse for a particle that has moved by `travel` metres; ""
/// if not.
std::string precision_warning(const Model& model, double travel);

/// Adds a fault if the loads move particles so far that strains in floats have errors above 1e-6 or
/// above a hundredth of the least strain at which springs break.
void check_precision(const Plan& plan, Faults& faults);

}  // namespace hyperlattice
