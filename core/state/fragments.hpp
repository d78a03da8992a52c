// The connected pieces of a body: particles that base springs join.
#pragma once

#include <state/present_springs.hpp>

#include <span>
#include <vector>

namespace hyperlattice {

/// Returns for each particle the number of its piece. Springs whose damage is at least `damage`
/// (above 0, at most 1) do not join; see joins(). Pieces are numbered by descending mass, and of
/// equal masses by their first particle. `masses`: of each particle, kg. The numbers do not depend
/// on the threads.
std::vector<double> fragments(const PresentSprings& springs, std::span<const double> masses,
                              double damage);

}  // namespace hyperlattice
