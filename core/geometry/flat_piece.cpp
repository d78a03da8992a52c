#include <geometry/cut_surface.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

/// Returns the distance of a point from the line between two others, m.
double distance(Vec3 x, Vec3 start, Vec3 end) {
  const Vec3 along = end - start;
  const double square = dot(along, along),
               t = square > 0 ? std::clamp(dot(x - start, along) / square, 0.0, 1.0) : 0;
  return norm(x - start - t * along);
}

}  // namespace

bool FlatPiece::crosses(Vec3 a, Vec3 b, double spacing) const {
  constexpr double shift = 1e-6;  // spacings; far above the rounding of positions
  const Vec3 moved = shift * spacing * moved_along;
  const double at_a = height(a - moved), at_b = height(b - moved);
  if ((at_a > 0) == (at_b > 0)) return false;
  if (outline == Outline::none) return true;
  // Moving the piece moves the crossing, so that a crossing near a rim counts. At a fold of a sheet
  // it must not: there only rounding counts.
  const double tolerance = outline == Outline::facet ? 1e-9 : 4 * shift;
  return holds(a - moved + at_a / (at_a - at_b) * (b - a), tolerance * spacing);
}

bool FlatPiece::holds(Vec3 crossing, double tolerance) const {
  if (outline == Outline::circle) return norm(crossing - point) <= radius + tolerance;
  // The polygon is seen along the axis that is nearest to its normal.
  const Vec3 size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
  const int across = size.x >= size.y && size.x >= size.z ? 0
                     : size.y >= size.z                   ? 1
                                                          : 2,
            u = (across + 1) % 3, v = (across + 2) % 3;
  bool is_inside = false;
  for (std::size_t n = 0; n < corners.size(); ++n) {
    const Vec3 start = corners[n], end = corners[(n + 1) % corners.size()];
    if (distance(crossing, start, end) <= tolerance) return true;
    if ((start[v] > crossing[v]) == (end[v] > crossing[v])) continue;
    const double at =
        start[u] + (crossing[v] - start[v]) / (end[v] - start[v]) * (end[u] - start[u]);
    if (at > crossing[u]) is_inside = !is_inside;
  }
  return is_inside;
}

}  // namespace hyperlattice
