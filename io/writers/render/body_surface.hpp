// The surface of the deformed body: the faces of its cubes that are open to the outside, to a crack
// or to particles that are not drawn.
#pragma once

#include "body_grid.hpp"
#include "broken_pairs.hpp"
#include "mesh.hpp"
#include "rest_corners.hpp"

#include <hyperlattice/fields.hpp>

namespace hyperlattice::render {

/// What a picture draws of a body.
struct DrawnBody {
  const Snapshot& snapshot;
  const BodyGrid& grid;
  const RestCorners& corners;
  const BrokenPairs& broken;
  const std::vector<bool>& is_drawn;  ///< of each particle
  std::span<const double> positions;  ///< x y z of each particle as drawn, m
  std::span<const ClipPlane> planes;
  bool has_cracks = true;  ///< faces at cracks are part of the surface

  Vec3 position(Particle particle) const {
    const double* x = &positions[3 * particle];
    return {x[0], x[1], x[2]};
  }
};

/// Returns the surface, closed by flat faces at the planes. A corner of cubes is at the mean of the
/// places that the deformation gradients of its particles give, taken over the cubes that hold
/// together around it, so that neighbours meet without gaps and open at cracks.
Mesh surface_of(const DrawnBody& body);

}  // namespace hyperlattice::render
