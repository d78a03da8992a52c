// Small cubes that fill the shape of a body whose particles do not stand for cubes.
#pragma once

#include <model/nearby.hpp>

namespace hyperlattice {

/// Returns a body with one site for each cube, `width` m wide, whose centre is inside the shape of
/// `body`; without a shape, near a particle. `nearby`: of the particles of `body`.
Body fill_with_cubes(const Body& body, const Nearby& nearby, double width);

}  // namespace hyperlattice
