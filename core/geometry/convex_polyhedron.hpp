// A convex body with flat faces, which planes cut into parts.
#pragma once

#include <geometry/solid_surface.hpp>

#include <vector>

namespace hyperlattice {

/// A convex polygon: corners, m, in order around it.
using Polygon = std::vector<Vec3>;

/// Calls visit(a, b, c) for each triangle of the fan that a polygon consists of.
template <class Visit>
void for_triangles(const Polygon& polygon, const Visit& visit) {
  for (std::size_t n = 2; n < polygon.size(); ++n) visit(polygon[0], polygon[n - 1], polygon[n]);
}

class ConvexPolyhedron {
 public:
  ConvexPolyhedron() = default;  ///< empty
  explicit ConvexPolyhedron(const Cube& cube);

  bool empty() const { return faces_.empty(); }
  double volume() const;  ///< m3
  /// Returns a point well inside, m: the mean of the corners of all faces.
  Vec3 middle() const;

  struct Parts;
  /// Cuts the body by a plane.
  Parts cut(const Plane& plane) const;

 private:
  std::vector<Polygon> faces_;  ///< anticlockwise, seen from outside
};

struct ConvexPolyhedron::Parts {
  ConvexPolyhedron below, above;  ///< on the plane's inner and outer side
  Polygon section;                ///< anticlockwise, seen from above; empty if a part is
};

}  // namespace hyperlattice
