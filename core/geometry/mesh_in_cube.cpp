// The volume of a mesh's solid inside a cube, by the divergence theorem along x: each facet counts
// the volume between the cube's lowest plane and the part of the facet beside the cube, from 0 to
// the cube's edge, positive if the facet faces along x. The sum is exact for any closed surface.
#include <geometry/convex_polyhedron.hpp>
#include <geometry/triangle_mesh.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

namespace {

/// Returns the part of a polygon whose coordinate along the axis is above (sign 1) or below (sign
/// -1) a bound.
Polygon part_beyond(const Polygon& polygon, int axis, double bound, double sign) {
  Polygon part;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const Vec3 a = polygon[n], b = polygon[(n + 1) % polygon.size()];
    const double from = sign * (a[axis] - bound), to = sign * (b[axis] - bound);
    if (from >= 0) part.push_back(a);
    if ((from > 0 && to < 0) || (from < 0 && to > 0)) {
      Vec3 crossing = a + from / (from - to) * (b - a);
      crossing[axis] = bound;
      part.push_back(crossing);
    }
  }
  return part;
}

/// Returns the integral of depth(x) over a polygon's projection along x, positive if the polygon
/// faces along x. `depth` must be linear.
template <class Depth>
double under(const Polygon& polygon, const Depth& depth) {
  double sum = 0;
  for_triangles(polygon, [&](Vec3 a, Vec3 b, Vec3 c) {
    const double area = 0.5 * ((b.y - a.y) * (c.z - a.z) - (b.z - a.z) * (c.y - a.y));
    sum += area * depth((a.x + b.x + c.x) / 3);
  });
  return sum;
}

/// A facet, and the box around it.
struct Triangle {
  Vec3 corners[3];
  Vec3 low, high;

  Triangle(Vec3 a, Vec3 b, Vec3 c)
      : corners{a, b, c},
        low{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
        high{std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})} {}
  bool touches(const Cube& cube, int axis) const {
    return low[axis] <= cube.high()[axis] && high[axis] >= cube.low[axis];
  }
  bool is_within(const Cube& cube, int axis) const {
    return low[axis] >= cube.low[axis] && high[axis] <= cube.high()[axis];
  }
};

}  // namespace

template <class Visit>
void InsideTest::for_facets_beside(const Cube& cube, const Visit& visit) const {
  const Vec3 high = cube.high();
  if (cube.low.y > high_.y || high.y < low_.y || cube.low.z > high_.z || high.z < low_.z) return;
  const Bins near{row_of(cube.low.z), row_of(high.z), column_of(cube.low.y), column_of(high.y)};
  for (std::size_t row = near.first_row; row <= near.last_row; ++row)
    for (std::size_t column = near.first_column; column <= near.last_column; ++column)
      for (const std::uint32_t f : bins_[row * side_ + column]) {
        const Facet& facet = mesh_.facets[f];
        const Bins own = bins_of(facet);
        // The first of the bins that the facet and the cube have in common.
        if (row != std::max(own.first_row, near.first_row) ||
            column != std::max(own.first_column, near.first_column))
          continue;
        const Triangle triangle(mesh_.points[facet[0]], mesh_.points[facet[1]],
                                mesh_.points[facet[2]]);
        if (triangle.touches(cube, 1) && triangle.touches(cube, 2)) visit(triangle);
      }
}

Side InsideTest::side_of(const Cube& cube) const {
  bool is_cut = false;
  for_facets_beside(cube, [&](const Triangle& t) { is_cut = is_cut || t.touches(cube, 0); });
  if (is_cut) return Side::cut;
  return winding(cube.centre()) != 0 ? Side::inside : Side::outside;
}

double InsideTest::volume_in(const Cube& cube) const {
  const Vec3 low = cube.low, high = cube.high();
  const auto depth = [&](double x) { return x - low.x; };
  const auto whole = [&](double) { return cube.edge; };
  double volume = 0;
  Polygon part;
  for_facets_beside(cube, [&](const Triangle& t) {
    if (t.high.x <= low.x) return;
    part.assign(std::begin(t.corners), std::end(t.corners));
    for (const int axis : {1, 2})
      if (!t.is_within(cube, axis))
        part = part_beyond(part_beyond(part, axis, low[axis], 1), axis, high[axis], -1);
    if (t.low.x < low.x) part = part_beyond(part, 0, low.x, 1);
    if (t.low.x >= high.x) {
      volume += under(part, whole);
    } else if (t.high.x <= high.x) {
      volume += under(part, depth);
    } else {
      volume += under(part_beyond(part, 0, high.x, -1), depth) +
                under(part_beyond(part, 0, high.x, 1), whole);
    }
  });
  return std::clamp(volume, 0.0, cube.volume());
}

std::vector<Plane> InsideTest::planes_in(const Cube& cube, std::size_t most) const {
  constexpr double alike = 1e-9;  // of the edge, and of 1
  std::vector<Plane> planes;
  for_facets_beside(cube, [&](const Triangle& t) {
    if (planes.size() > most || !t.touches(cube, 0)) return;
    const Vec3 doubled = cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
    const double size = norm(doubled);
    if (!(size > 0)) return;
    const Plane plane{t.corners[0], doubled / size};
    if (SolidSurface{plane.point, plane.normal}.side_of(cube) != Side::cut) return;
    const Vec3 foot = cube.centre() - plane.height(cube.centre()) * plane.normal;
    const auto is_same = [&](const Plane& other) {
      return norm(cross(other.normal, plane.normal)) < alike &&
             std::abs(other.height(foot)) < alike * cube.edge;
    };
    if (std::none_of(planes.begin(), planes.end(), is_same)) planes.push_back(plane);
  });
  return planes;
}

}  // namespace hyperlattice
