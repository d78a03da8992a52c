// The faces between particles whose springs are broken or damaged.
#pragma once

#include <state/present_springs.hpp>

#include <hyperlattice/output.hpp>

#include <vector>

namespace hyperlattice {

/// Returns the faces of the springs that the lattice's cuts took away, with the time 0 and the
/// damage 1.
std::vector<CrackFace> cut_faces(const Model& model);

/// Returns the faces of all springs that criteria broke, and of those whose damage is at least
/// `damage` (above 0, at most 1), in the order of their first ends and neighbours. See CrackFace.
std::vector<CrackFace> crack_faces(const Model& model, const Simulation& simulation, double damage);

}  // namespace hyperlattice
