// The part of a cube's volume that lies inside a solid.
#pragma once

#include <geometry/region.hpp>

namespace hyperlattice {

/// Returns the part, 0 to 1, of the cube's volume that lies inside a solid or a set of solids. It
/// is exact up to round-off for flat surfaces, meshes and images, and correct to 1e-4 where round
/// surfaces cut the cube. Deterministic.
double volume_share(const Region& solid, const Cube& cube);

}  // namespace hyperlattice
