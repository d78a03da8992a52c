// The plane z = const cuts each facet that has points below it and others on or above it in one
// segment, from the edge that leads up to the edge that leads down. The segments of a closed
// surface form closed polygons, since neighbours compute their common end identically. The same
// holds for the line y = const in that plane.
#include <geometry/triangle_mesh.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

namespace {

/// The point where an edge crosses the plane. It is the same for both facets, since the lower point
/// always comes first.
struct Crossing {
  double x = 0, y = 0;
};
Crossing crossing(Vec3 a, Vec3 b, double z) {
  if (a.z > b.z) std::swap(a, b);
  const double share = (z - a.z) / (b.z - a.z);
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
}

bool reaches(double z, double plane) {
  return z >= plane;
}  // a point on the plane counts as above, for all facets

}  // namespace

InsideTest::InsideTest(TriangleMesh mesh)
    : mesh_(std::move(mesh)),
      low_{infinity, infinity, infinity},
      high_{-infinity, -infinity, -infinity} {
  for (const Vec3 p : mesh_.points) {
    low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z)};
    high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y), std::max(high_.z, p.z)};
  }
  constexpr double finest = 512;
  side_ = static_cast<std::size_t>(
      std::clamp(std::sqrt(static_cast<double>(mesh_.facets.size())), 1.0, finest));
  bins_.resize(side_ * side_);
  for (std::uint32_t f = 0; f < mesh_.facets.size(); ++f) {
    const Bins bins = bins_of(mesh_.facets[f]);
    for (std::size_t row = bins.first_row; row <= bins.last_row; ++row)
      for (std::size_t column = bins.first_column; column <= bins.last_column; ++column)
        bins_[row * side_ + column].push_back(f);
  }
}

InsideTest::Bins InsideTest::bins_of(const Facet& facet) const {
  const double slack = 1e-12 * std::max(high_.y - low_.y,
                                        high_.z - low_.z);  // rounding error of a crossing
  const Vec3 a = mesh_.points[facet[0]], b = mesh_.points[facet[1]], c = mesh_.points[facet[2]];
  return {row_of(std::min({a.z, b.z, c.z}) - slack), row_of(std::max({a.z, b.z, c.z}) + slack),
          column_of(std::min({a.y, b.y, c.y}) - slack),
          column_of(std::max({a.y, b.y, c.y}) + slack)};
}

std::size_t InsideTest::column_of(double y) const {
  const double share = (y - low_.y) / (high_.y - low_.y);
  return std::min(static_cast<std::size_t>(std::max(0.0, share) * static_cast<double>(side_)),
                  side_ - 1);
}

std::size_t InsideTest::row_of(double z) const {
  const double share = (z - low_.z) / (high_.z - low_.z);
  return std::min(static_cast<std::size_t>(std::max(0.0, share) * static_cast<double>(side_)),
                  side_ - 1);
}

int InsideTest::winding(Vec3 p) const {
  if (!(p.y >= low_.y && p.y <= high_.y && p.z >= low_.z && p.z <= high_.z && p.x >= low_.x &&
        p.x <= high_.x))
    return 0;
  int winding = 0;
  for (const std::uint32_t f : bins_[row_of(p.z) * side_ + column_of(p.y)]) {
    const Facet& facet = mesh_.facets[f];
    Crossing up, down;
    bool cut = false;
    for (std::size_t n = 0; n < 3; ++n) {
      const Vec3 a = mesh_.points[facet[n]], b = mesh_.points[facet[(n + 1) % 3]];
      if (reaches(a.z, p.z) == reaches(b.z, p.z)) continue;
      (reaches(b.z, p.z) ? up : down) = crossing(a, b, p.z);
      cut = true;
    }
    if (!cut || (up.y >= p.y) == (down.y >= p.y)) continue;
    const bool rises = down.y >= p.y;
    if (up.y > down.y) std::swap(up, down);
    const double share = (p.y - up.y) / (down.y - up.y), x = up.x + share * (down.x - up.x);
    if (x >= p.x) winding += rises ? -1 : 1;
  }
  return winding;
}

}  // namespace hyperlattice
