// The end of the volumetric energy of a cell: a cell acts only while all its springs are there. A
// cell that lost a spring in a step acts to the end of this step.
#pragma once

#include <state/block_set.hpp>

#include <vector>

namespace hyperlattice {

/// Takes their volumetric energy from the cells of the spring from particle `a` to a neighbour.
/// Adds to `lost` the energy that each cell loses, J, with half of the work of the last step of
/// length `step`, s, as FailureRecord counts it for springs; 0 if another rank knows it. Must be
/// called after the step, by one thread.
void lose_cells(const BlockSet& blocks, Particle a, std::uint32_t neighbour, double step,
                std::vector<double>& lost);

}  // namespace hyperlattice
