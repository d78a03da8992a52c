#include <model/nearby.hpp>
#include <model/region_membership.hpp>
#include <model/skin.hpp>

#include <map>

namespace hyperlattice {

namespace {

/// The cubes as a lattice with one site for each cube.
struct Cubes {
  const Body& body;
  const Nearby& nearby;
  double width;

  bool holds(Vec3 centre) const {
    if (body.grid.shape != nullptr) return body.grid.shape->contains(centre);
    return nearby.nearest(centre).distance <=
           0.87 * body.grid.spacing;  // 0.87: half the diagonal of a unit cube
  }

  void send(const LatticeSink& sink) const {
    const Shape* shape = body.grid.shape;
    const double margin = shape != nullptr ? 0 : body.grid.spacing;
    const Vec3 around{margin, margin, margin},
        low = shape != nullptr ? shape->low : body.lowest - around,
        high = shape != nullptr ? shape->high : body.highest + around;
    const Vec3 anchor = shape != nullptr ? shape->anchor : low;
    const auto first = [&](double from, double at) {
      return std::floor((from - at) / width + 1e-6);
    };
    const auto count = [&](double from, double to, double at) {
      return static_cast<std::int32_t>(std::ceil((to - at) / width - 1e-6) - first(from, at));
    };
    Grid grid;
    grid.spacing = grid.membrane_distance = width;
    grid.site_volume = width * width * width;
    grid.sites = {count(low.x, high.x, anchor.x), count(low.y, high.y, anchor.y),
                  count(low.z, high.z, anchor.z)};
    const Vec3 half{0.5 * width, 0.5 * width, 0.5 * width};
    grid.origin =
        anchor +
        width * Vec3{first(low.x, anchor.x), first(low.y, anchor.y), first(low.z, anchor.z)} + half;
    sink.grid(grid);
    for (std::int32_t k = 0; k < grid.sites[2]; ++k)
      for (std::int32_t j = 0; j < grid.sites[1]; ++j) {
        const auto inside = [&](std::int32_t i) {
          return holds(grid.origin + width * Vec3{double(i), double(j), double(k)});
        };
        for (std::int32_t i = 0; i < grid.sites[0]; ++i) {
          if (!inside(i)) continue;
          const std::int32_t begin = i;
          while (++i < grid.sites[0] && inside(i)) {
          }
          sink.run(j, k, begin, i);
        }
      }
  }
};

constexpr LatticeFunctions cubes_functions{
    [](const void* lattice, const LatticeSink& sink, const Complaint& why) noexcept {
      return detail::guarded(why, [&] { static_cast<const Cubes*>(lattice)->send(sink); });
    }};

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
  const Cubes filled{body, nearby, width_};
  const Body cubes = build_body(cubes_functions, &filled);
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
