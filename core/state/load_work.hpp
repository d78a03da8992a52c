// The work of loads. Each block keeps the work of its contributions up to the last step.
#pragma once

#include <state/block_set.hpp>
#include <state/equilibrium_update.hpp>

#include <vector>

namespace hyperlattice {

/// Returns the acceleration, m/s2, that takes the speed from `before` to `after`, m/s, in a kick of
/// this duration, s; at rest, where the kick has none, 0.
inline double acceleration_in(double kick, double before, double after) {
  return kick > 0 ? (after - before) / kick : 0;
}

/// Returns the force, N, with which a load prescribes the motion of a particle along an axis: mass
/// times acceleration, less all other forces in the last evaluation. `speed`: m/s, after a kick of
/// the duration `kick`, s; 0: at rest.
double reaction(const Block& block, const Contribution& part, int axis, double speed, double kick);

/// Adds the work of the step that the block has just done with a kick of this duration, s.
void count_work(Block& block, double kick);
/// Adds the work on the way from one state of rest to the next. Only the ends of the way are known:
/// the work is the mean of the forces at both ends times the displacement between them.
void count_work(BlockSet& blocks, const EquilibriumUpdate& to);

/// Returns the work of each load, J, up to the state that was measured last. The reaction of a
/// constraint counts for its load, and takes back the work of other loads along the same axis.
/// `potential`: the work of body accelerations, J; `last_step`: length of the last step, s.
std::vector<double> work_by_load(const BlockSet& blocks, double potential, double last_step);
/// Returns the sum of the absolute works, J, of each load on each particle, because works may
/// cancel. A body acceleration on a held particle and the reaction also cancel in each step of
/// length `step`, s.
double gross_work(const BlockSet& blocks, double potential, double step);

/// Returns for each load the force, N, on the particles that it moves, along the axes that it
/// prescribes, in the state that was measured last.
std::vector<Vec3> force_by_load(const BlockSet& blocks);

}  // namespace hyperlattice
