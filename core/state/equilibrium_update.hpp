// What a static solver hands over to the state of a run.
#pragma once

#include <vector>

namespace hyperlattice {

/// A change from one state of rest to another without a time step. Fields have x, y, z of each
/// particle; heights exist only in free membranes.
struct EquilibriumUpdate {
  double time = 0;                   ///< after the change, s
  std::vector<double> xyz, heights;  ///< displacements after the change, m
  /// Forces of the springs on the particles after and before the change, N.
  std::vector<double> force, force_before;
  std::vector<double> factor, factor_before;  ///< load factor of each load
  double gravity = 1, gravity_before = 1;     ///< fractions of the body accelerations
  double dissipated = 0;  ///< by the forces that held the earlier state in place, J
};

}  // namespace hyperlattice
