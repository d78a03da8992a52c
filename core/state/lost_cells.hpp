// The end of the volumetric energy of a cell: a cell acts only while all its springs are there. A
// cell that lost a spring in a step acts to the end of this step.
#pragma once

#include <state/block_set.hpp>

namespace hyperlattice {

/// Takes their volumetric energy from the cells of the spring from particle `a` to a neighbour.
/// Returns the energy that is lost, J, with half of the work of the last step of length `step`, s,
/// as FailureRecord counts it for springs. Must be called after the step, by one thread.
double lose_cells(const BlockSet& blocks, Particle a, std::uint32_t neighbour, double step);

}  // namespace hyperlattice
