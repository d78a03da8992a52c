#include <geometry/convex_polyhedron.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

namespace {

/// A corner and its distance from the plane that cuts.
struct Corner {
  Vec3 at;
  double height;
};

/// Returns the part of a face on the lower (sign 1) or upper (sign -1) side of the plane.
Polygon part_of(const std::vector<Corner>& face, double sign) {
  Polygon part;
  for (std::size_t n = 0; n < face.size(); ++n) {
    const Corner &a = face[n], &b = face[(n + 1) % face.size()];
    if (sign * a.height <= 0) part.push_back(a.at);
    if (a.height * b.height < 0) {
      // The same bits for both faces at the edge.
      const bool forward = a.height < b.height;
      const Corner &from = forward ? a : b, &to = forward ? b : a;
      part.push_back(from.at + from.height / (from.height - to.height) * (to.at - from.at));
    }
  }
  return part;
}

/// Puts the corners of a convex polygon in order around the normal.
void sort_around(Polygon& polygon, Vec3 normal) {
  Vec3 middle;
  for (const Vec3 x : polygon) middle += x / static_cast<double>(polygon.size());
  const Vec3 across = std::abs(normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0},
             u = cross(normal, across), v = cross(normal, u);
  const auto angle = [&](Vec3 x) { return std::atan2(dot(x - middle, v), dot(x - middle, u)); };
  std::sort(polygon.begin(), polygon.end(), [&](Vec3 a, Vec3 b) { return angle(a) < angle(b); });
}

}  // namespace

ConvexPolyhedron::ConvexPolyhedron(const Cube& cube) {
  constexpr unsigned sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                    {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  const Vec3 high = cube.high();
  for (const auto& side : sides) {
    Polygon& face = faces_.emplace_back();
    for (const unsigned n : side)
      face.push_back({(n & 1U) != 0 ? high.x : cube.low.x, (n & 2U) != 0 ? high.y : cube.low.y,
                      (n & 4U) != 0 ? high.z : cube.low.z});
  }
}

double ConvexPolyhedron::volume() const {
  double sum = 0;
  if (empty()) return sum;
  const Vec3 origin = faces_.front().front();
  for (const Polygon& face : faces_)
    for_triangles(face, [&](Vec3 a, Vec3 b, Vec3 c) {
      sum += dot(a - origin, cross(b - origin, c - origin));
    });
  return sum / 6;
}

Vec3 ConvexPolyhedron::middle() const {
  Vec3 sum;
  double corners = 0;
  for (const Polygon& face : faces_)
    for (const Vec3 x : face) {
      sum += x;
      ++corners;
    }
  return sum / corners;
}

ConvexPolyhedron::Parts ConvexPolyhedron::cut(const Plane& plane) const {
  constexpr double rounding = 1e-12;  // of the largest distance
  double lowest = 0, highest = 0;
  std::vector<std::vector<Corner>> faces;
  for (const Polygon& face : faces_) {
    std::vector<Corner>& corners = faces.emplace_back();
    for (const Vec3 x : face) {
      corners.push_back({x, plane.height(x)});
      lowest = std::min(lowest, corners.back().height);
      highest = std::max(highest, corners.back().height);
    }
  }
  const double nothing = rounding * (highest - lowest);
  if (highest <= nothing) return {*this, {}, {}};
  if (lowest >= -nothing) return {{}, *this, {}};
  Parts parts;
  for (std::vector<Corner>& face : faces) {
    for (Corner& corner : face) {
      if (std::abs(corner.height) <= nothing) corner.height = 0;
    }
    const auto take = [&](ConvexPolyhedron& to, double sign) {
      Polygon part = part_of(face, sign);
      if (part.size() > 2) to.faces_.push_back(std::move(part));
    };
    take(parts.below, 1);
    take(parts.above, -1);
    for (std::size_t n = 0; n < face.size(); ++n) {
      const Corner &a = face[n], &b = face[(n + 1) % face.size()];
      if (a.height == 0) parts.section.push_back(a.at);
      // Each edge belongs to two faces, which pass it in opposite directions.
      if (a.height < 0 && b.height > 0)
        parts.section.push_back(a.at + a.height / (a.height - b.height) * (b.at - a.at));
    }
  }
  sort_around(parts.section, plane.normal);
  parts.below.faces_.push_back(parts.section);
  parts.above.faces_.emplace_back(parts.section.rbegin(), parts.section.rend());
  return parts;
}

}  // namespace hyperlattice
