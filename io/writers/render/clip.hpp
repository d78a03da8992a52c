// Cuts a surface by planes and closes it with flat faces.
#pragma once

#include "mesh.hpp"

#include <span>

namespace hyperlattice::render {

/// A deformed cube that a plane may cut.
struct CutCube {
  std::array<std::uint32_t, 8> corners{};  ///< indices in Mesh::points, in the order of Corners
  std::uint32_t particle = 0;
};

/// Takes away what is beyond any of the planes, and adds the faces in the planes of these cubes.
void clip(Mesh& mesh, std::span<const ClipPlane> planes, std::span<const CutCube> cubes);

}  // namespace hyperlattice::render
