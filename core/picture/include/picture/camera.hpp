// A camera that looks along `forward` at a target. In view space x points right, y up and z away
// from the eye; the origin is the target, and the unit is a pixel at the target's depth. The ray of
// the pixel (X, Y) is
//   (X, Y, 0) + z (k X, k Y, 1),
// with k = 1 / distance of the eye for a perspective view and k = 0 for an orthographic view.
#pragma once

#include <hyperlattice/plain.hpp>

#include <algorithm>
#include <span>

namespace hyperlattice::picture {

struct Camera {
  Vec3 right, up, forward, target;
  double scale = 1;  ///< pixels per metre
  double k = 0;      ///< 1 / pixels
  double x = 0,
         y = 0;  ///< position of the target in the image, pixels from the top left corner

  Vec3 to_view(Vec3 point) const {
    const Vec3 p = scale * (point - target);
    return {dot(p, right), dot(p, up), dot(p, forward)};
  }
};

/// The part of an image that a body may fill, pixels.
struct Frame {
  double left = 0, top = 0, width = 0, height = 0;
};

/// Returns a camera that looks from the direction `view` and shows in the frame all cubes of the
/// given edge, m, about the points, [x y z] each, m.
inline Camera make_camera(std::span<const double> points, double edge, Vec3 view, bool perspective,
                          Frame frame) {
  Camera camera;
  camera.forward = (-1 / norm(scaled(view))) * scaled(view);
  const Vec3 sideways = cross(camera.forward, {0, 0, 1});  // z is up, or y for a view along z
  camera.right = norm(sideways) > 1e-6 ? sideways / norm(sideways) : Vec3{1, 0, 0};
  camera.up = cross(camera.right, camera.forward);

  Vec3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  for (std::size_t n = 0; n < points.size(); n += 3) {
    const Vec3 p = camera.to_view({points[n], points[n + 1], points[n + 2]});
    if (!std::isfinite(p.x + p.y + p.z)) continue;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const auto seen_edge = [&](Vec3 axis) {
    return edge * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
  };
  const Vec3 centre = 0.5 * (low + high);
  const Vec3 size =
      high - low + Vec3{seen_edge(camera.right), seen_edge(camera.up), seen_edge(camera.forward)};
  camera.target = centre.x * camera.right + centre.y * camera.up + centre.z * camera.forward;
  const double distance = 2.5 * norm(size);  // from the eye to the target, m
  const double nearer =
      perspective ? 1 / (1 - 0.5 * size.z / distance) : 1;  // magnification of the front
  camera.scale = std::min(frame.width / size.x, frame.height / size.y) / nearer;
  camera.k = perspective ? 1 / (camera.scale * distance) : 0;
  camera.x = frame.left + 0.5 * frame.width;
  camera.y = frame.top + 0.5 * frame.height;
  return camera;
}

}  // namespace hyperlattice::picture
