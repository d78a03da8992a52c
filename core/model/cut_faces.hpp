// The springs that cuts took away, with the surfaces that took them: what a load needs that acts
// across a closed cut.
#pragma once

#include <model/model.hpp>
#include <model/region_index.hpp>

#include <vector>

namespace hyperlattice {

/// Returns what a body must have so that forces of base springs alone can close its cuts, as a text
/// for a fault; null if it has this.
const char* expected_of_closed_cuts(const Model& model);

/// Returns the springs that the cuts of a grid took away and that have both ends among the
/// particles, which must be ascending; see LoadBody::cut_springs(). Needs complete materials.
std::vector<SeveredSpring> cut_springs_in(const Model& model, RegionIndex& regions,
                                          std::span<const Particle> particles);

}  // namespace hyperlattice
