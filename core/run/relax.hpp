// To a static state: Newton's method, each step of it by conjugate gradients, with the steps of a simulation as the source of forces.
#pragma once

#include <run/state.hpp>

namespace hyperlattice {

struct Rest {
  std::uint64_t evaluations = 0;  ///< of all forces
  double residual = 0;            ///< largest component of the force on a particle that nothing holds, over the mean force on a held one
};

/// Moves the particles until the residual is no more than `residual`. Loads must have reached what they prescribe after one critical time step,
/// one of them must hold particles, and nothing may break. RunError if the body does not come to rest.
Rest relax(Simulation& simulation, const Model& model, double residual);

}  // namespace hyperlattice
