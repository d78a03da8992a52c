// Draws a scene by rays: colours, light, transparency.
#pragma once

#include "raster.hpp"
#include "ray_scene.hpp"

#include <picture/palette.hpp>

#include <hyperlattice/output.hpp>

namespace hyperlattice::render {

/// How the parts of a scene look.
struct Look {
  std::span<const picture::Colour> particles;  ///< of each particle
  std::span<const Triangle> triangles;         ///< those of the RayScene
  std::span<const Line> lines;
  bool has_crack_colour = false;  ///< crack faces have their own colour and are opaque
  picture::Colour crack{}, open_line{}, closed_line{};
  double opacity = 1;           ///< of the surface, without crack faces
  double light = 0;             ///< 0: colours as they are; 1: full light and shade
  double shade_reach = 0;       ///< up to which distance surfaces shade each other, pixels
  int samples = 4;              ///< along each side of a pixel
  bool is_transparent = false;  ///< the background; else white
  bool has_outline = false;     ///< a dark line where the body ends
};

/// Draws what the camera sees in a part of the picture. The bits do not depend on the number of
/// threads.
Raster trace(const Snapshot& snapshot, const RayScene& scene, const Look& look,
             const picture::Camera& camera, int width, int height, picture::Frame area);

}  // namespace hyperlattice::render
