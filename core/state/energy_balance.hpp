// The energy balance of a body.
#pragma once

#include <hyperlattice/plain.hpp>

#include <cstdint>

namespace hyperlattice {

/// Energies and momentum of the whole body at one time.
struct EnergyBalance {
  double kinetic = 0, kinetic_mean = 0, stored = 0, injected = 0, dissipated_failure = 0,
         dissipated_damping = 0;  ///< J
  Vec3 momentum;                  ///< N s
  double dissipated() const { return dissipated_failure + dissipated_damping; }
  double error = 0;  ///< J: kinetic + stored + dissipated - injected - energy at the start
  /// The largest value so far, J, of each kind of energy and of the sum of the absolute works.
  double scale = 0;
  /// How often motion was set, stopped or damped from outside of the loads so far: the momentum
  /// begins anew there.
  std::uint64_t interventions = 0;
  double relative_error() const { return scale > 0 ? error / scale : 0; }
};

}  // namespace hyperlattice
