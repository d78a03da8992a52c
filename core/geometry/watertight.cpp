// Whether triangles bound a solid. Each edge is run through once in each direction if every facet has one neighbour across it and both face the same
// way.
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

/// Six times the volume of the tetrahedron of a facet and a point: summed over a closed surface, of what it encloses.
double volume(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& facet, Vec3 origin) {
  const Vec3 a = mesh.points[facet[0]] - origin, b = mesh.points[facet[1]] - origin, c = mesh.points[facet[2]] - origin;
  return dot(a, cross(b, c));
}

/// For each point the number of the connected part it belongs to, which is one of its points.
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

}  // namespace

std::string solid_fault(const TriangleMesh& mesh) {
  std::unordered_map<std::uint64_t, std::size_t> facet_of;  // of an edge in this direction
  const auto edge_text = [&](std::uint32_t a, std::uint32_t b) {
    return fmt::format("the edge from {} to {} (metres)", place(mesh.points[a]), place(mesh.points[b]));
  };
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    for (std::size_t n = 0; n < 3; ++n) {
      const std::uint32_t a = mesh.facets[f][n], b = mesh.facets[f][(n + 1) % 3];
      const auto [found, is_new] = facet_of.emplace(key(a, b), f);
      if (!is_new)
        return fmt::format("facets {} and {} run through {} in the same direction: one of them faces the wrong way, or more than two meet there",
                           found->second + 1, f + 1, edge_text(a, b));
    }
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    for (std::size_t n = 0; n < 3; ++n) {
      const std::uint32_t a = mesh.facets[f][n], b = mesh.facets[f][(n + 1) % 3];
      if (facet_of.count(key(b, a)) == 0) return fmt::format("the surface is open: no other facet shares {} of facet {}", edge_text(a, b), f + 1);
    }
  double sum = 0;
  for (const auto& facet : mesh.facets) sum += volume(mesh, facet, mesh.points.front());
  return sum > 0 ? "" : "its facets point inwards: turn them round";
}

SurfaceAreas surface_areas(const TriangleMesh& mesh) {
  struct Part {
    double volume = 0, area = 0;
  };
  std::map<std::uint32_t, Part> found;
  const auto part_of = parts(mesh);
  for (const auto& facet : mesh.facets) {
    Part& part = found[part_of[facet[0]]];
    const Vec3 a = mesh.points[facet[0]];
    part.volume += volume(mesh, facet, mesh.points.front());
    part.area += norm(cross(mesh.points[facet[1]] - a, mesh.points[facet[2]] - a)) / 2;
  }
  SurfaceAreas areas;
  for (const auto& [point, part] : found) (part.volume > 0 ? areas.outer : areas.inner) += part.area;
  return areas;
}

}  // namespace hyperlattice
