// Checks whether triangles bound a solid. If each facet has one neighbour at each edge and both
// face the same way, the facets pass each edge once in each direction.
#include <geometry/triangle_mesh.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <unordered_map>

namespace hyperlattice {

namespace {

std::uint64_t key(std::uint32_t from, std::uint32_t to) { return (std::uint64_t{from} << 32) | to; }

std::string place(Vec3 p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z); }

/// Returns six times the volume of the tetrahedron of a facet and a point. The sum over a closed
/// surface is six times the enclosed volume.
double volume(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& facet, Vec3 origin) {
  const Vec3 a = mesh.points[facet[0]] - origin, b = mesh.points[facet[1]] - origin,
             c = mesh.points[facet[2]] - origin;
  return dot(a, cross(b, c));
}

/// Returns for each point the number of its connected part, which is the index of one point of the
/// part.
std::vector<std::uint32_t> parts(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.points.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t p) {
    while (parent[p] != p) p = parent[p] = parent[parent[p]];
    return p;
  };
  for (const auto& facet : mesh.facets)
    for (const std::uint32_t corner : {facet[1], facet[2]}) parent[root(corner)] = root(facet[0]);
  for (std::uint32_t p = 0; p < parent.size(); ++p) parent[p] = root(p);
  return parent;
}

Vec3 centroid(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& facet) {
  return (1.0 / 3) * (mesh.points[facet[0]] + mesh.points[facet[1]] + mesh.points[facet[2]]);
}

/// Returns the outward normal with twice the facet's area as its length.
Vec3 doubled_area(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& facet) {
  const Vec3 a = mesh.points[facet[0]];
  return cross(mesh.points[facet[1]] - a, mesh.points[facet[2]] - a);
}

/// Returns a hint if another corner is almost at one of the ends a, b of an open edge, so that only
/// rounding separates them; otherwise an empty text.
std::string near_miss(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b) {
  constexpr double close = 1e-5;  // relative to the surface's extent
  Vec3 low = mesh.points.front(), high = low;
  double distance = infinity;
  for (std::uint32_t p = 0; p < mesh.points.size(); ++p) {
    const Vec3 point = mesh.points[p];
    low = {std::min(low.x, point.x), std::min(low.y, point.y), std::min(low.z, point.z)};
    high = {std::max(high.x, point.x), std::max(high.y, point.y), std::max(high.z, point.z)};
    for (const std::uint32_t end : {a, b})
      if (p != end) distance = std::min(distance, norm(point - mesh.points[end]));
  }
  if (distance > close * norm(high - low)) return "";
  return fmt::format(
      "; another corner is {:.2g} m from there: corners of neighbours must be the same to the last "
      "digit",
      distance);
}

/// Returns why the facets from `first` up to `last` are not a closed surface, in which each edge
/// belongs to two facets; empty if they are one.
std::string closed_fault(const TriangleMesh& mesh, std::size_t first, std::size_t last) {
  std::unordered_map<std::uint64_t, std::size_t> facet_of;  // key: directed edge
  const auto edge_text = [&](std::uint32_t a, std::uint32_t b) {
    return fmt::format("the edge from {} to {} (metres)", place(mesh.points[a]),
                       place(mesh.points[b]));
  };
  for (std::size_t f = first; f < last; ++f)
    for (std::size_t n = 0; n < 3; ++n) {
      const std::uint32_t a = mesh.facets[f][n], b = mesh.facets[f][(n + 1) % 3];
      const auto [found, is_new] = facet_of.emplace(key(a, b), f);
      if (!is_new)
        return fmt::format(
            "facets {} and {} run through {} in the same direction: one of them faces the wrong "
            "way, or more than two meet there",
            mesh.numbers[found->second], mesh.numbers[f], edge_text(a, b));
    }
  for (std::size_t f = first; f < last; ++f)
    for (std::size_t n = 0; n < 3; ++n) {
      const std::uint32_t a = mesh.facets[f][n], b = mesh.facets[f][(n + 1) % 3];
      if (facet_of.count(key(b, a)) == 0)
        return fmt::format("the surface is open: no other facet shares {} of facet {}{}",
                           edge_text(a, b), mesh.numbers[f], near_miss(mesh, a, b));
    }
  double sum = 0;
  for (std::size_t f = first; f < last; ++f)
    sum += volume(mesh, mesh.facets[f], mesh.points.front());
  return sum > 0 ? "" : "its facets point inwards: turn them round";
}

}  // namespace

std::string solid_fault(const TriangleMesh& mesh) {
  return closed_fault(mesh, 0, mesh.facets.size());
}

bool sections_are_solids(const TriangleMesh& mesh) {
  if (mesh.sections.size() < 2) return false;
  for (std::size_t n = 0; n < mesh.sections.size(); ++n) {
    const std::size_t first = mesh.sections[n], last = n + 1 < mesh.sections.size()
                                                           ? mesh.sections[n + 1]
                                                           : mesh.facets.size();
    if (first < last && !closed_fault(mesh, first, last).empty()) return false;
  }
  return true;
}

std::string orientation_fault(const InsideTest& inside) {
  const TriangleMesh& mesh = inside.mesh();
  struct Part {
    double volume = 0;
    std::vector<std::size_t> facets;
  };
  std::map<std::uint32_t, Part> found;
  const auto part_of = parts(mesh);
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    Part& part = found[part_of[mesh.facets[f][0]]];
    part.volume += volume(mesh, mesh.facets[f], mesh.points.front());
    part.facets.push_back(f);
  }
  if (found.size() < 2) return "";
  const double step = 1e-7 * norm(inside.high() - inside.low());
  for (const auto& [point, part] : found) {
    const bool is_outer = part.volume > 0;
    // An outer part has no material at its outside; a cavity has material around it.
    const auto is_right = [&](std::size_t f) {
      const Vec3 normal = doubled_area(mesh, mesh.facets[f]);
      const double size = norm(normal);
      if (!(size > 0)) return false;
      const int winding = inside.winding(centroid(mesh, mesh.facets[f]) +
                                         (is_outer ? step : -step) / size * normal);
      return is_outer ? winding <= 0 : winding > 0;
    };
    if (std::any_of(part.facets.begin(), part.facets.end(), is_right)) continue;
    const std::uint32_t number = mesh.numbers[part.facets.front()];
    if (is_outer)
      return fmt::format(
          "the closed surface that facet {} belongs to lies within another and faces outwards: "
          "around a cavity facets point into it",
          number);
    return fmt::format(
        "the closed surface that facet {} belongs to lies within no other and points inwards: turn "
        "its facets round",
        number);
  }
  return "";
}

SurfaceAreas surface_areas(const TriangleMesh& mesh) {
  struct Part {
    double volume = 0, area = 0;
  };
  std::map<std::uint32_t, Part> found;
  const auto part_of = parts(mesh);
  for (const auto& facet : mesh.facets) {
    Part& part = found[part_of[facet[0]]];
    part.volume += volume(mesh, facet, mesh.points.front());
    part.area += norm(doubled_area(mesh, facet)) / 2;
  }
  SurfaceAreas areas;
  for (const auto& [point, part] : found)
    (part.volume > 0 ? areas.outer : areas.inner) += part.area;
  return areas;
}

}  // namespace hyperlattice
