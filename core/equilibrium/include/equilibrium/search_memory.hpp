// What searches take over from those before them, besides displacements and springs, as numbers of
// a checkpoint: a stage that goes on in its middle has the same bits as one that was never cut off.
#pragma once

#include <equilibrium/newton.hpp>

#include <span>
#include <vector>

namespace hyperlattice::equilibrium {

/// Adds the memory of the search and what its preconditioner was made from.
void remember(const Newton& newton, std::vector<double>& all);
/// Goes on with what remember() added, before the first search. Returns the numbers behind it.
/// Throws std::runtime_error if they are of another solver or body.
std::span<const double> recall(std::span<const double> all, Newton& newton);

}  // namespace hyperlattice::equilibrium
