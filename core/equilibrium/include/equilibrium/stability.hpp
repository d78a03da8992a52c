// The stability of a state of rest: it is unstable if the tangent K has a negative eigenvalue.
#pragma once

#include <equilibrium/system.hpp>

#include <numerics/conjugate_gradients.hpp>

namespace hyperlattice::equilibrium {

/// Returns a motion x with x . K x < 0, along which the body buckles; empty if none is found. The
/// system must be prepared. The search is conjugate gradients for a random right side: the
/// preconditioner makes the softest motions the largest, so that they meet such a motion if it
/// exists. Free rigid motions do not count.
Field softening_motion(System& system, numerics::ConjugateGradients& gradients,
                       const Field& displacement);

}  // namespace hyperlattice::equilibrium
