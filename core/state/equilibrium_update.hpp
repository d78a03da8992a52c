// What a static or an implicit solver hands over to the state of a run.
#pragma once

#include <hyperlattice/plain.hpp>

#include <vector>

namespace hyperlattice {

/// A change from one state of rest to another without a time step, or an implicit step in time.
/// Fields have x, y, z of each particle; heights exist only in free membranes.
struct EquilibriumUpdate {
  double time = 0;                   ///< after the change, s
  std::vector<double> xyz, heights;  ///< displacements after the change, m
  /// Forces of the springs on the particles after and before the change, N.
  std::vector<double> force, force_before;
  std::vector<double> factor, factor_before;  ///< load factor of each load
  double gravity = 1, gravity_before = 1;     ///< fractions of the body accelerations
  /// Whether springs broke in the earlier state, which is not at rest: all energy that the change
  /// sets free counts as dissipated.
  bool settles = false;
  /// By the forces that held the earlier state in place, or by the method of a step in time, J.
  double dissipated = 0;
  // The members below belong to a step in time; `force` and `force_before` are then both its mean
  // force, less inertia where a load prescribes motion, and so are the factors.
  double time_step = 0;                       ///< s; 0: a change between states of rest
  double forward = 1;                         ///< part of the step at which its means lie
  std::vector<double> velocity, height_rate;  ///< after the step, m/s
  std::vector<std::vector<Vec3>> answers;     ///< mean answers of each load, N
};

}  // namespace hyperlattice
