// The derivative of an expression, computed together with its value (automatic differentiation).
#pragma once

#include <quantities/compiled.hpp>

namespace hyperlattice {

/// Returns the derivative of an expression along `direction`: the change of its value for a small
/// change of the inputs by `direction`, over the size of the change. At a kink it is that of one
/// side. Both spans have one number for each input.
double derivative(const Compiled& expression, std::span<const double> inputs,
                  std::span<const double> direction);

}  // namespace hyperlattice
