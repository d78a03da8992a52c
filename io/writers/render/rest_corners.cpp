#include "rest_corners.hpp"

#include <algorithm>
#include <utility>

namespace hyperlattice::render {

namespace {

/// An edge of the surface, from one corner to another one.
using Edge = std::pair<std::uint64_t, std::uint64_t>;

/// Returns all edges of the open faces, in both directions, ascending.
std::vector<Edge> surface_edges(const BodyGrid& grid) {
  std::vector<Edge> edges;
  for (Place cube; cube.k < grid.count(2); ++cube.k)
    for (cube.j = 0; cube.j < grid.count(1); ++cube.j)
      for (cube.i = 0; cube.i < grid.count(0); ++cube.i) {
        if (grid.particle(cube) == BodyGrid::none) continue;
        for (int direction = 0; direction < 6; ++direction) {
          if (grid.particle(neighbour_of(cube, direction)) != BodyGrid::none) continue;
          for (int side = 0; side < 4; ++side) {
            const auto index = [&](int n) {
              return grid.corner_index(corner_of(cube, face_corners[direction][n % 4]));
            };
            edges.emplace_back(index(side), index(side + 1));
            edges.emplace_back(index(side + 1), index(side));
          }
        }
      }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace

RestCorners::RestCorners(const BodyGrid& grid, int steps) {
  constexpr double inwards = 0.5, outwards = -0.53;
  if (steps == 0) return;
  const std::vector<Edge> edges = surface_edges(grid);
  std::vector<std::uint64_t> corners;
  for (const Edge& edge : edges)
    if (corners.empty() || corners.back() != edge.first) corners.push_back(edge.first);
  std::vector<std::uint32_t> ends;  // the entry of the second corner of each edge
  ends.reserve(edges.size());
  for (const Edge& edge : edges)
    ends.push_back(static_cast<std::uint32_t>(
        std::lower_bound(corners.begin(), corners.end(), edge.second) - corners.begin()));
  std::vector<Vec3> points, moved(corners.size());
  points.reserve(corners.size());
  for (const std::uint64_t corner : corners)
    points.push_back(grid.corner(grid.corner_place(corner)));
  for (int step = 0; step < 2 * steps; ++step) {
    const double share = step % 2 == 0 ? inwards : outwards;
    std::size_t edge = 0;
    for (std::size_t n = 0; n < corners.size(); ++n) {
      Vec3 sum;
      double count = 0;
      for (; edge < edges.size() && edges[edge].first == corners[n]; ++edge, ++count)
        sum += points[ends[edge]];
      moved[n] = points[n] + share * (sum / count - points[n]);
    }
    std::swap(points, moved);
  }
  for (std::size_t n = 0; n < corners.size(); ++n) moved_.emplace(corners[n], points[n]);
}

}  // namespace hyperlattice::render
