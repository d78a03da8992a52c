// The stiffness of a coarser level by Galerkin projection, P^T K P. P is the interpolation from the
// coarser level, 0 for held components. So a coarse level includes every hole, broken spring,
// material boundary and support of the finer level.
#pragma once

#include <equilibrium/spring_level.hpp>
#include <equilibrium/stencil_level.hpp>

#include <memory>

namespace hyperlattice::equilibrium {

/// Returns the level that is coarser than `fine` by one step.
std::unique_ptr<StencilLevel> coarsen(const SpringLevel& fine, const TrilinearTransfer& transfer);
std::unique_ptr<StencilLevel> coarsen(const StencilLevel& fine, const TrilinearTransfer& transfer);

}  // namespace hyperlattice::equilibrium
