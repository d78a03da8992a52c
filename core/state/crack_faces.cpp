#include <model/section.hpp>
#include <state/crack_faces.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace hyperlattice {

namespace {

/// A spring at rest.
struct Geometry {
  Vec3 rest;  ///< from the first end to the other one, m
  std::uint32_t spring_class = 0;
  double share = 1;
};

/// Returns a spring that a cut took away; see Body::for_cut_springs.
Geometry geometry_of_cut(const Model& model, Particle a, Particle b, std::uint32_t neighbour) {
  const Body& body = model.body;
  if (body.is_listed()) return {body.position(b) - body.position(a), 0, 1};
  const NeighbourGeometry& to = model.springs.neighbours[neighbour];
  return {to.rest, to.site.spring_class, body.share(body.site(a), to.site)};
}

/// The failure of a spring.
struct Failed {
  Particle b = 0;
  double time = std::numeric_limits<double>::quiet_NaN();  ///< s; NaN: the spring has not failed
  double damage = 1;
};
/// By first end and neighbour.
using FailedSprings = std::map<std::pair<Particle, std::uint32_t>, Failed>;

FailedSprings failed_springs(const Simulation& simulation, double damage) {
  FailedSprings all;
  for (const Breakage& breakage : simulation.breakages())
    if (!breakage.again) all[{breakage.a, breakage.neighbour}] = {breakage.b, breakage.time, 1};
  for (const WeakenedSpring& spring : simulation.weakened_springs()) {
    if (joins(spring.integrity, damage)) continue;
    Failed& failed = all[{spring.a, spring.neighbour}];
    failed.b = spring.b;
    failed.damage = 1 - spring.integrity;
  }
  return all;
}

/// Two directions of length 1 across a spring. Those of a spring along an axis are axes.
std::pair<Vec3, Vec3> across(Vec3 spring) {
  std::size_t least = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (std::abs(spring[axis]) < std::abs(spring[least])) least = axis;
  Vec3 axis;
  axis[least] = 1;
  const Vec3 first = direction_of(cross(spring, axis));
  return {first, direction_of(cross(spring, first))};
}

class Faces {
 public:
  explicit Faces(const Model& model)
      : model_(model), body_(model.body), m_(crossing_factor(model)) {}

  /// Adds the faces of the spring from a to its neighbour.
  void add(Particle a, std::uint32_t neighbour, const Geometry& of, const Failed& failed,
           std::vector<CrackFace>& faces) const {
    CrackFace face;
    face.a = a;
    face.b = failed.b;
    face.spring_class = of.spring_class;
    face.time = failed.time;
    face.damage = failed.damage;
    const Vec3 middle = body_.position(a) + 0.5 * of.rest;
    const auto [u, v] = across(of.rest);
    if (of.spring_class != 0) {
      set_square(face, middle, u, v, body_.grid.spacing / 4);
      faces.push_back(face);
    } else if (of.share == 1 || body_.cells.empty()) {
      face.area = of.share * norm(of.rest) / m_;
      set_square(face, middle, u, v, std::sqrt(face.area));
      faces.push_back(face);
    } else {
      add_quarters(body_.site(a), model_.springs.neighbours[neighbour].site, middle, face, faces);
    }
  }

 private:
  static void set_square(CrackFace& face, Vec3 middle, Vec3 u, Vec3 v, double edge) {
    const Vec3 along = edge / 2 * u, up = edge / 2 * v;
    face.corners[0] = middle - along - up;
    face.corners[1] = middle + along - up;
    face.corners[2] = middle + along + up;
    face.corners[3] = middle - along + up;
  }

  /// Adds a square in each cell of an orthogonal spring, from the spring's middle towards the
  /// middle of the cell.
  void add_quarters(Site site, const Neighbour& to, Vec3 middle, CrackFace face,
                    std::vector<CrackFace>& faces) const {
    for_cells_of(to, [&](int di, int dj, int dk) {
      const double share = body_.cells.share_of_cell(Site{site.i + di, site.j + dj, site.k + dk});
      if (share == 0) return;
      const double edge = std::sqrt(share) * body_.grid.spacing / 2;
      const double towards[3] = {di < 0 ? -edge : edge, dj < 0 ? -edge : edge,
                                 dk < 0 ? -edge : edge};
      const int along = to.dx != 0 ? 0 : to.dy != 0 ? 1 : 2;
      Vec3 first, second;
      first[(along + 1) % 3] = towards[(along + 1) % 3];
      second[(along + 2) % 3] = towards[(along + 2) % 3];
      face.area = edge * edge;
      face.corners[0] = middle;
      face.corners[1] = middle + first;
      face.corners[2] = middle + first + second;
      face.corners[3] = middle + second;
      faces.push_back(face);
    });
  }

  const Model& model_;
  const Body& body_;
  double m_;  ///< 1/m, see PlaneSection
};

}  // namespace

std::vector<CrackFace> crack_faces(const Model& model, const Simulation& simulation,
                                   double damage) {
  const FailedSprings failed = failed_springs(simulation, damage);
  std::vector<CrackFace> faces;
  if (failed.empty()) return faces;
  const Faces shapes(model);
  faces.reserve(failed.size());
  for (const auto& [spring, how] : failed) {
    const SpringProperties of = model.spring_properties(spring.first, how.b, spring.second);
    shapes.add(spring.first, spring.second, {of.rest, of.spring_class, of.share}, how, faces);
  }
  return faces;
}

std::vector<CrackFace> cut_faces(const Model& model) {
  std::vector<CrackFace> faces;
  const std::uint64_t springs = model.body.cut_springs();
  if (springs == 0) return faces;
  const Faces shapes(model);
  faces.reserve(springs);
  model.body.for_cut_springs([&](Particle a, Particle b, std::uint32_t neighbour) {
    shapes.add(a, neighbour, geometry_of_cut(model, a, b, neighbour), {b, 0, 1}, faces);
  });
  return faces;
}

}  // namespace hyperlattice
