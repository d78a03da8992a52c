// Whether floats hold what a scene asks for. A displacement u is known to u / 2^24, so elongations
// to about as much: what is lost is the strain u / (2^24 l) of a spring as long as the lattice
// constant l, wherever the body has moved far from where it started.
#pragma once

#include <plan/plan.hpp>

namespace hyperlattice {

/// A sentence if a particle that has moved by `travel` metres leaves floats too coarse; empty if
/// not.
std::string precision_warning(const Model& model, double travel);

/// A fault if the loads move particles so far that floats would not know the strain: to 1e-6 or a
/// hundredth of the least strain at which springs break.
void check_precision(const Plan& plan, Faults& faults);

}  // namespace hyperlattice
