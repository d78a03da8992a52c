// The limit of the time step and its reason.
#pragma once

#include <string>

namespace hyperlattice {

/// What limits the time step of explicit solvers.
struct StepLimit {
  /// Stable time step, s: exact for one material, a rigorous lower bound for several materials and
  /// for loads that answer to the motion.
  double time_step = 0;
  std::string because;  ///< sentence: what limits the time step
  /// If the mirrored layer is stable: a sentence about the deformation that would grow if both
  /// layers were free; empty if none would.
  std::string two_layers_grow;
};

}  // namespace hyperlattice
