#include <geometry/solid_surface.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

double SolidSurface::height(Vec3 x) const {
  if (is_plane()) return dot(x - point, direction);
  const double outwards = norm(radial(x)) - radius;
  return is_cavity ? -outwards : outwards;
}

Side SolidSurface::side_of(const Cube& cube) const {
  // A cube that touches the surface from one side, up to round-off, is on that side.
  constexpr double rounding = 1e-9;
  const double away = height(cube.centre()),
               reach = 0.5 * cube.edge *
                       (is_plane()
                            ? std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z)
                            : std::sqrt(3.0));
  if (std::abs(away) < (1 - rounding) * reach) return Side::cut;
  return away < 0 ? Side::inside : Side::outside;
}

Plane SolidSurface::tangent(Vec3 x) const {
  if (is_plane()) return {point, direction};
  const Vec3 outwards = radial(x);
  const double distance = norm(outwards);
  // Any plane is as good for a point on the axis, which only a tiny sphere or cylinder has in a
  // cube that it cuts.
  const Vec3 normal = distance > 0 ? outwards / distance : Vec3{1, 0, 0};
  return {x - (distance - radius) * normal, is_cavity ? -normal : normal};
}

double SolidSurface::sag(Vec3 on_tangent) const {
  if (is_plane()) return 0;
  const Vec3 r = radial(on_tangent);
  const double square = std::max(0.0, 2 * radius * radius - dot(r, r)),
               deep = radius - std::sqrt(square);
  return is_cavity ? -deep : deep;
}

}  // namespace hyperlattice
