// Whether a state of rest is a stable one.
#pragma once

#include "system.hpp"

#include <numerics/conjugate_gradients.hpp>

namespace hyperlattice::statics {

/// A motion along which the present tangents, prepared, are negative: the body buckles along it.
/// Empty if none is found. Conjugate gradients from a rough field meet it, if there is one, as the
/// preconditioner makes the softest motions the largest. Free rigid motions do not count.
Field softening_motion(System& system, numerics::ConjugateGradients& gradients,
                       const Field& displacement);

}  // namespace hyperlattice::statics
