#include "clip.hpp"

#include "rest_corners.hpp"

#include <utility>

namespace hyperlattice::render {

namespace {

/// A flat convex polygon of few points: a triangle has at most one more for each plane.
using Polygon = std::vector<Vec3>;

/// Returns where the edge from a to b meets the plane. The order of the ends does not matter, so
/// that neighbours get the same point.
Vec3 meet(Vec3 a, double beyond_a, Vec3 b, double beyond_b) {
  if (beyond_a > beyond_b) {
    std::swap(a, b);
    std::swap(beyond_a, beyond_b);
  }
  return a + beyond_a / (beyond_a - beyond_b) * (b - a);
}

/// Takes away what is beyond the plane.
void clip(Polygon& polygon, const ClipPlane& plane) {
  Polygon kept;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const Vec3 a = polygon[n], b = polygon[(n + 1) % polygon.size()];
    const double beyond_a = plane.beyond(a), beyond_b = plane.beyond(b);
    if (beyond_a <= 0) kept.push_back(a);
    if ((beyond_a < 0 && beyond_b > 0) || (beyond_a > 0 && beyond_b < 0))
      kept.push_back(meet(a, beyond_a, b, beyond_b));
  }
  polygon = std::move(kept);
}

void add(Mesh& mesh, const Polygon& polygon, std::uint32_t particle, Part part) {
  if (polygon.size() < 3) return;
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), polygon.begin(), polygon.end());
  for (std::uint32_t n = 2; n < polygon.size(); ++n)
    mesh.triangles.push_back({{first, first + n - 1, first + n}, particle, part});
}

/// Returns where a plane cuts a tetrahedron: three or four points, or none.
Polygon section(const ClipPlane& plane, const std::array<Vec3, 4>& corners) {
  double beyond[4];
  std::vector<std::size_t> before, after;
  for (std::size_t n = 0; n < 4; ++n) {
    beyond[n] = plane.beyond(corners[n]);
    (beyond[n] <= 0 ? before : after).push_back(n);
  }
  const auto at = [&](std::size_t a, std::size_t b) {
    return meet(corners[a], beyond[a], corners[b], beyond[b]);
  };
  if (before.size() == 1)
    return {at(before[0], after[0]), at(before[0], after[1]), at(before[0], after[2])};
  if (after.size() == 1)
    return {at(before[0], after[0]), at(before[1], after[0]), at(before[2], after[0])};
  if (before.size() == 2)
    return {at(before[0], after[0]), at(before[0], after[1]), at(before[1], after[1]),
            at(before[1], after[0])};
  return {};
}

/// Adds the faces of a cube in a plane. The cube is cut into 24 tetrahedra that have its centre,
/// the centre of a face and an edge, so that neighbours meet.
void add_section(Mesh& mesh, const CutCube& cube, std::span<const ClipPlane> planes,
                 std::size_t number) {
  const ClipPlane& plane = planes[number];
  Vec3 corners[8], centre;
  bool is_before = false, is_after = false;
  for (std::size_t n = 0; n < 8; ++n) {
    corners[n] = mesh.points[cube.corners[n]];
    centre += corners[n] / 8;
    (plane.beyond(corners[n]) > 0 ? is_after : is_before) = true;
  }
  if (!is_before || !is_after) return;
  for (const auto& face : face_corners) {
    Vec3 middle;
    for (const int corner : face) middle += corners[corner] / 4;
    for (std::size_t side = 0; side < 4; ++side) {
      Polygon polygon =
          section(plane, {centre, middle, corners[face[side]], corners[face[(side + 1) % 4]]});
      for (std::size_t other = 0; other < planes.size() && !polygon.empty(); ++other)
        if (other != number) clip(polygon, planes[other]);
      add(mesh, polygon, cube.particle, Part::section);
    }
  }
}

}  // namespace

void clip(Mesh& mesh, std::span<const ClipPlane> planes, std::span<const CutCube> cubes) {
  if (planes.empty()) return;
  const std::vector<Triangle> all = std::exchange(mesh.triangles, {});
  for (const Triangle& triangle : all) {
    Polygon polygon;
    bool is_cut = false;
    for (const std::uint32_t point : triangle.points) {
      polygon.push_back(mesh.points[point]);
      for (const ClipPlane& plane : planes) is_cut |= plane.beyond(mesh.points[point]) > 0;
    }
    if (!is_cut) {
      mesh.triangles.push_back(triangle);
      continue;
    }
    for (const ClipPlane& plane : planes) clip(polygon, plane);
    add(mesh, polygon, triangle.particle, triangle.part);
  }
  for (const CutCube& cube : cubes)
    for (std::size_t number = 0; number < planes.size(); ++number)
      add_section(mesh, cube, planes, number);
}

}  // namespace hyperlattice::render
