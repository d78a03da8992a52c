// A camera that looks along `forward` at a target. In view space x points right, y up and z away
// from the eye; the origin is the target, and the unit is a pixel at the target's depth. The ray of
// the pixel (X, Y) is
//   (X, Y, 0) + z (k X, k Y, 1),
// with k = 1 / distance of the eye for a perspective view and k = 0 for an orthographic view.
#pragma once

#include <hyperlattice/plain.hpp>

#include <algorithm>
#include <cstdint>
#include <span>
#include <string_view>

namespace hyperlattice::picture {

enum class Projector : std::uint32_t { orthographic, perspective };
inline constexpr std::string_view projector_names[] = {"orthographic", "perspective"};
/// What a camera shows in each frame: the body at rest, or the body as it is drawn.
enum class Fit : std::uint32_t { rest, frame };
inline constexpr std::string_view fit_names[] = {"rest", "frame"};

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

/// Returns a direction to the right for a camera that looks along `forward`, so that `up`, of
/// length 1 as `forward`, points up in the picture. A camera that looks along `up` has x on its
/// right, or y if it looks along x.
inline Vec3 right_of(Vec3 forward, Vec3 up) {
  const Vec3 sideways = cross(forward, up);
  if (norm(sideways) > 1e-6) return sideways / norm(sideways);
  const Vec3 axis = std::abs(forward.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 across = axis - dot(axis, forward) * forward;
  return across / norm(across);
}

/// Returns a camera that looks from the direction `view`, with `up` towards the upper edge, and
/// shows in the frame all cubes of the given edge, m, about the points, [x y z] each, m.
inline Camera make_camera(std::span<const double> points, double edge, Vec3 view,
                          Projector projector, Frame frame, Vec3 up = {0, 0, 1}) {
  Camera camera;
  camera.forward = (-1 / norm(scaled(view))) * scaled(view);
  camera.right = right_of(camera.forward, up);
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
  const double nearer = projector == Projector::perspective ? 1 / (1 - 0.5 * size.z / distance)
                                                            : 1;  // magnification of the front
  camera.scale = std::min(frame.width / size.x, frame.height / size.y) / nearer;
  camera.k = projector == Projector::perspective ? 1 / (camera.scale * distance) : 0;
  camera.x = frame.left + 0.5 * frame.width;
  camera.y = frame.top + 0.5 * frame.height;
  return camera;
}

}  // namespace hyperlattice::picture
