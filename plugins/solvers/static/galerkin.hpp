// The stiffness of a coarser level: P^T K P, with P the interpolation from it, 0 in what is held.
// So a coarse level knows every hole, broken spring, border of materials and support of the level
// below.
#pragma once

#include "spring_level.hpp"
#include "stencil_level.hpp"

#include <memory>

namespace hyperlattice::statics {

std::unique_ptr<StencilLevel> coarsen(const SpringLevel& fine, const TrilinearTransfer& transfer);
std::unique_ptr<StencilLevel> coarsen(const StencilLevel& fine, const TrilinearTransfer& transfer);

}  // namespace hyperlattice::statics
