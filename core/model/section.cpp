#include <model/nodal_volumes.hpp>
#include <model/section.hpp>

#include <algorithm>

namespace hyperlattice {
namespace {

/// A plane with its unit normal, and the particles that it divides.
class Division {
 public:
  Division(const Body& body, Vec3 point, Vec3 normal, std::span<const Particle> among)
      : body_(body), point_(point), normal_(direction_of(normal)), among_(among) {}

  Vec3 normal() const { return normal_; }
  /// Returns the distance of a particle from the plane, m; positive beyond it.
  double height(Particle particle) const { return dot(body_.position(particle) - point_, normal_); }
  bool is_beyond(double height) const { return height > 1e-9 * body_.grid.spacing; }
  bool has(Particle particle) const {
    return particle != Body::no_particle &&
           (among_.size() == body_.particles ||
            std::binary_search(among_.begin(), among_.end(), particle));
  }

 private:
  const Body& body_;
  Vec3 point_, normal_;
  std::span<const Particle> among_;
};

void cut_list(const Model& model, const Division& plane, std::vector<CutSpring>& found) {
  const std::vector<ListedSpring>& springs = model.body.listed.springs;
  for (std::uint32_t n = 0; n < springs.size(); ++n) {
    const Particle a = springs[n].a, b = springs[n].b;
    const bool a_is_beyond = plane.is_beyond(plane.height(a));
    if (a_is_beyond == plane.is_beyond(plane.height(b)) || !plane.has(a) || !plane.has(b)) continue;
    found.push_back({a, b, n, !a_is_beyond});
  }
}

/// Adds the springs from a particle before the plane to particles beyond it.
void cut_grid(const Model& model, const Division& plane, Particle before,
              std::vector<CutSpring>& found) {
  const Body& body = model.body;
  const Site here = body.site(before);
  for (std::uint32_t n = 0; n < body.neighbours.size(); ++n) {
    const Neighbour& to = body.neighbours[n];
    const Site next{here.i + to.dx, here.j + to.dy, here.k + to.dz},
        previous{here.i - to.dx, here.j - to.dy, here.k - to.dz};
    const Particle after = body.at(next), ahead = body.at(previous);
    const auto counts = [&](Particle other, Site first, Particle at_first) {
      return plane.has(other) && plane.is_beyond(plane.height(other)) &&
             body.share(first, to) > 0 && !body.is_cut(at_first, n);
    };
    if (counts(after, here, before)) found.push_back({before, after, n, true});
    if (counts(ahead, previous, ahead)) found.push_back({ahead, before, n, false});
  }
}

std::vector<CutCell> cut_cells(const Model& model, const Division& plane) {
  std::vector<CutCell> found;
  model.volumetric.for_cells([&](Site site, double modulus) {
    CutCell cell{model.volumetric.corners(site), modulus, 0};
    if (!std::all_of(cell.corners.begin(), cell.corners.end(),
                     [&](Particle corner) { return plane.has(corner); }))
      return;
    for (std::size_t n = 0; n < 8; ++n)
      if (!plane.is_beyond(plane.height(cell.corners[n])))
        cell.before = static_cast<std::uint8_t>(cell.before | 1U << n);
    if (cell.before != 0 && cell.before != 0xff) found.push_back(cell);
  });
  return found;
}

std::vector<CutTetrahedron> cut_tetrahedra(const Model& model, const Division& plane) {
  std::vector<CutTetrahedron> found;
  if (!model.nodal_volumes) return found;
  const Tetrahedra& all = model.nodal_volumes->tetrahedra();
  for (std::uint32_t t = 0; t < all.size(); ++t) {
    CutTetrahedron cut{t, 0};
    for (std::size_t n = 0; n < 4; ++n)
      if (!plane.is_beyond(plane.height(all[t][n])))
        cut.before = static_cast<std::uint8_t>(cut.before | 1U << n);
    if (cut.before != 0 && cut.before != 0xf &&
        std::all_of(all[t].begin(), all[t].end(),
                    [&](Particle corner) { return plane.has(corner); }))
      found.push_back(cut);
  }
  return found;
}

}  // namespace

double crossing_factor(const Model& model) {
  const Body& body = model.body;
  double squares = 0, volume = body.grid.site_volume;
  for (const NeighbourGeometry& to : model.springs.neighbours)
    if (to.site.spring_class == 0) squares += dot(to.rest, to.rest);
  if (body.is_listed()) {
    volume = 0;
    for (Particle p = 0; p < body.particles; ++p) volume += body.grid.site_volume * body.share(p);
    for (const auto* springs : {&body.listed.springs, &body.listed.cut})
      for (const ListedSpring& spring : *springs) {
        const Vec3 rest = body.position(spring.b) - body.position(spring.a);
        squares += dot(rest, rest);
      }
  }
  return squares / (3 * volume);
}

PlaneSection cut(const Model& model, Vec3 point, Vec3 normal, std::span<const Particle> among) {
  const Division plane(model.body, point, normal, among);
  PlaneSection section;
  if (model.body.is_listed()) {
    cut_list(model, plane, section.springs);
  } else {
    double longest = 0;
    for (const NeighbourGeometry& to : model.springs.neighbours)
      longest = std::max(longest, to.rest_length);
    for (const Particle particle : among) {
      const double height = plane.height(particle);
      if (height > -longest && !plane.is_beyond(height))
        cut_grid(model, plane, particle, section.springs);
    }
  }
  section.cells = cut_cells(model, plane);
  section.tetrahedra = cut_tetrahedra(model, plane);
  Vec3 sum;
  for (const CutSpring& spring : section.springs) {
    const SpringProperties of = model.spring_properties(spring.a, spring.b, spring.neighbour);
    if (of.spring_class == 0) sum += (spring.a_is_before ? of.share : -of.share) * of.rest;
  }
  if (!section.springs.empty()) section.area = dot(sum, plane.normal()) / crossing_factor(model);
  return section;
}

}  // namespace hyperlattice
