// The names of the numerics library that this solver uses without a prefix.
#pragma once

#include <numerics/trilinear_transfer.hpp>

namespace hyperlattice::equilibrium {

using numerics::Field;
using numerics::Floats;
using numerics::GridLayout;
using numerics::GridLevel;
using numerics::in_pieces;
using numerics::largest;
using numerics::largest_magnitude;
using numerics::Parents;
using numerics::power_of_two;
using numerics::product;
using numerics::TrilinearTransfer;
using numerics::Window;

}  // namespace hyperlattice::equilibrium
