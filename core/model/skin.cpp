#include <model/region_membership.hpp>
#include <model/shape_cubes.hpp>
#include <model/skin.hpp>

#include <map>

namespace hyperlattice {

namespace {

/// The particles of a body and the faces of its skin, see region_membership.hpp. The skin is built
/// on first use.
struct SkinPlaces {
  using Point = Particle;
  using Face = Skin::Face;

  const Body& body;
  const std::function<const Skin&()>& skin;

  bool in_solid(const Region& region, Particle particle) const {
    return region.inside(body.position(particle));
  }
  bool has_face(const Region& region, Particle particle) const {
    return (region.kind != Region::Kind::outer_surface && skin().has_inner(particle)) ||
           (region.kind != Region::Kind::inner_surface && skin().has_outer(particle));
  }
  /// Returns whether a particle is in the outermost layer of a side. The particles of a list need
  /// not lie in planes: their layer is one spacing thick from the end of the shape, or without a
  /// shape half a spacing from the last particle.
  bool is_outermost(Particle particle, int direction) const {
    const Shape* shape = body.is_listed() ? body.grid.shape : nullptr;
    const Vec3 low = shape != nullptr ? shape->low : body.lowest,
               high = shape != nullptr ? shape->high : body.highest;
    const double depth = (shape != nullptr ? 1 : body.is_listed() ? 0.5 : 1e-6) * body.grid.spacing;
    return dot(body.position(particle) - (direction % 2 == 0 ? low : high),
               face_normals[direction]) > -depth;
  }
  bool is_open(const Region& region, const Face& face) const {
    switch (region.kind) {
      case Region::Kind::inner_surface:
        return face.inner;
      case Region::Kind::outer_surface:
        return !face.inner;
      case Region::Kind::face:
        return face.direction == region.direction;
      default:
        return true;
    }
  }
  template <class Visit>
  void for_points(const Face& face, const Visit& visit) const {
    visit(face.particle);
  }
};

}  // namespace

Skin::Skin(const Body& body) : width_(body.grid.spacing / 2), sides_(body.particles, 0) {
  const Nearby nearby(body);
  const Body cubes = fill_with_cubes(body, nearby, width_);
  const Surfaces surfaces(cubes);
  for (const Run& run : cubes.runs)
    for (Site cube{run.begin, run.j, run.k}; cube.i < run.end; ++cube.i) {
      const OpenFaces open = surfaces.faces(cube),
                      inner = open == 0 ? 0 : surfaces.inner_faces(cube);
      for (std::uint8_t direction = 0; direction < 6; ++direction) {
        if ((open >> direction & 1U) == 0) continue;
        // The nearest particle to a point slightly outside: particles of the outermost plane come
        // before those behind them.
        const Particle particle =
            nearby.nearest(cubes.position(cube) + width_ * face_normals[direction]).particle;
        const bool is_inner = (inner >> direction & 1U) != 0;
        faces_.push_back({particle, direction, is_inner});
        sides_[particle] = static_cast<std::uint8_t>(sides_[particle] | (is_inner ? 1U : 2U));
      }
    }
}

std::vector<Particle> particles_in(const Body& body, const std::function<const Skin&()>& skin,
                                   const Region& region) {
  const SkinPlaces places{body, skin};
  const RegionMembership<SkinPlaces> membership(places);
  std::vector<Particle> found;
  for (Particle particle = 0; particle < body.particles; ++particle)
    if (membership.holds(region, particle)) found.push_back(particle);
  return found;
}

std::vector<OpenArea> open_areas(const Body& body, const std::function<const Skin&()>& skin,
                                 const Region& region) {
  const SkinPlaces places{body, skin};
  const RegionMembership<SkinPlaces> membership(places);
  std::map<Particle, Vec3> areas;
  for (const Skin::Face& face : skin().faces())
    if (membership.holds_face(region, face)) {
      Vec3& area = areas[face.particle];
      area += skin().face_area() * face_normals[face.direction];
    }
  std::vector<OpenArea> found;
  found.reserve(areas.size());
  for (const auto& [particle, area] : areas) found.push_back({particle, area});
  return found;
}

}  // namespace hyperlattice
