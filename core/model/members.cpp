// The particles, cells and faces of a region in a body on a cubic grid.
#include <geometry/volume_share.hpp>
#include <model/region_membership.hpp>
#include <model/surfaces.hpp>

#include <map>

namespace hyperlattice {

namespace {

/// The sites of a body and the faces of its cells, see region_membership.hpp.
struct Sites {
  using Point = Site;
  struct Face {
    Site cell;
    int direction = 0;  ///< as face_normals
  };

  const Body& body;
  const Surfaces& surfaces;

  bool in_solid(const Region& region, Site particle) const {
    return body.cells.empty() ? region.inside(body.position(particle))
                              : touches(region, body.position(particle));
  }

  /// Returns whether the face is open to the side of the region.
  bool is_open(const Region& region, const Face& face) const {
    const auto among = [&](OpenFaces open) { return (open >> face.direction & 1U) != 0; };
    switch (region.kind) {
      case Region::Kind::inner_surface:
        return among(surfaces.inner_faces(face.cell));
      case Region::Kind::outer_surface:
        return among(surfaces.outer_faces(face.cell));
      case Region::Kind::face:
        return face.direction == region.direction && among(surfaces.faces(face.cell));
      default:
        return among(surfaces.faces(face.cell));
    }
  }

  /// Calls visit(site) for each particle of the face: its four corners, or the particle in the
  /// middle of the cell.
  template <class Visit>
  void for_points(const Face& face, const Visit& visit) const {
    const Site cell = face.cell;
    if (body.cells.empty()) return visit(cell);
    // Returns the offset of a corner from the low corner of the cell along one axis, 0 or 1 cells.
    const auto corner = [&](int axis, int along, int across) {
      return axis == face.direction / 2             ? face.direction % 2
             : axis == (face.direction / 2 + 1) % 3 ? along
                                                    : across;
    };
    for (const int along : {0, 1})
      for (const int across : {0, 1})
        visit(Site{cell.i + corner(0, along, across), cell.j + corner(1, along, across),
                   cell.k + corner(2, along, across)});
  }

  /// Returns whether a face of the particle is open to the side of the region.
  bool has_face(const Region& region, Site particle) const {
    const auto any_open = [&](Site cell, auto&& touched) {
      for (int direction = 0; direction < 6; ++direction)
        if (touched(direction) && is_open(region, {cell, direction})) return true;
      return false;
    };
    if (body.cells.empty()) return any_open(particle, [](int) { return true; });
    bool found = false;
    for_cells_of({}, [&](int di, int dj, int dk) {
      const Site cell{particle.i + di, particle.j + dj, particle.k + dk};
      // If the cell is below the particle (offset -1), the particle is at the upper face of the
      // cell.
      const int offset[3] = {di, dj, dk};
      found = found || (body.cells.holds(cell) && any_open(cell, [&](int direction) {
                          return (direction % 2 == 1) == (offset[direction / 2] < 0);
                        }));
    });
    return found;
  }

  /// Returns whether the point, or one within round-off of it, is in the solid.
  bool touches(const Region& solid, Vec3 point) const {
    const double rounding = 1e-6 * body.grid.spacing;
    const Vec3 low = solid.low - point, high = solid.high - point;
    if (std::max({low.x, low.y, low.z}) > rounding ||
        std::min({high.x, high.y, high.z}) < -rounding)
      return false;
    if (solid.inside(point)) return true;
    for (const double x : {-rounding, 0.0, rounding})
      for (const double y : {-rounding, 0.0, rounding})
        for (const double z : {-rounding, 0.0, rounding})
          if (solid.inside(point + Vec3{x, y, z})) return true;
    return false;
  }

  bool is_last(Site site, int direction) const {
    const Vec3 outward = face_normals[direction],
               farthest = direction % 2 == 0 ? body.lowest : body.highest;
    return dot(body.position(site) - farthest, outward) > -1e-6 * body.grid.spacing;
  }
  bool is_outermost(Site site, int direction) const {
    return is_last(site, direction) || surfaces.is_at_cut_end(site, direction);
  }
};

/// The cells of a body as points at their centres, see region_membership.hpp.
struct Centres {
  using Point = Site;
  using Face = Sites::Face;

  const Sites& sites;

  Vec3 centre(Site cell) const {
    return sites.body.position(cell) + 0.5 * sites.body.grid.spacing * Vec3{1, 1, 1};
  }
  bool in_solid(const Region& region, Site cell) const {
    const double share = sites.body.cells.share_of_cell(cell);
    return share == 1
               ? region.inside(centre(cell))
               : volume_share(region, {sites.body.position(cell), sites.body.grid.spacing}) >=
                     0.5 * share;
  }
  bool has_face(const Region& region, Site cell) const {
    for (int direction = 0; direction < 6; ++direction)
      if (sites.is_open(region, {cell, direction})) return true;
    return false;
  }
  bool is_outermost(Site cell, int direction) const {
    return sites.is_last(direction % 2 == 0 ? cell : Site{cell.i + 1, cell.j + 1, cell.k + 1},
                         direction);
  }
};

}  // namespace

std::vector<Particle> cells_in(const Body& body, const Surfaces& surfaces, const Region& region) {
  const Sites sites{body, surfaces};
  const Centres centres{sites};
  const RegionMembership<Centres> membership(centres);
  std::vector<Particle> found;
  for (const Run& run : body.cells.runs())
    for (std::int32_t i = run.begin; i < run.end; ++i)
      if (membership.holds(region, {i, run.j, run.k}))
        found.push_back(run.first + static_cast<Particle>(i - run.begin));
  return found;
}

void for_particles_in(const Body& body, const Surfaces& surfaces, const Region& region,
                      const std::function<void(Particle)>& visit) {
  const Sites sites{body, surfaces};
  const RegionMembership<Sites> membership(sites);
  for (const Run& run : body.runs)
    for (std::int32_t i = run.begin; i < run.end; ++i)
      if (membership.holds(region, {i, run.j, run.k}))
        visit(run.first + static_cast<Particle>(i - run.begin));
}

std::vector<Particle> particles_in(const Body& body, const Surfaces& surfaces,
                                   const Region& region) {
  std::vector<Particle> found;
  if (region.kind == Region::Kind::all) found.reserve(body.particles);  // many: no copies
  for_particles_in(body, surfaces, region, [&](Particle particle) { found.push_back(particle); });
  return found;
}

std::vector<OpenArea> open_areas(const Body& body, const Surfaces& surfaces, const Region& region) {
  const Sites sites{body, surfaces};
  const RegionMembership<Sites> membership(sites);
  const double face_area = body.grid.spacing * body.grid.spacing,
               share = body.cells.empty() ? 1 : 0.25;
  std::map<Particle, Vec3> areas;
  for (const Run& run : body.cells.empty() ? std::span(body.runs) : body.cells.runs())
    for (Site cell{run.begin, run.j, run.k}; cell.i < run.end; ++cell.i) {
      const OpenFaces open = surfaces.faces(cell);
      for (int direction = 0; direction < 6; ++direction) {
        if ((open >> direction & 1U) == 0 || !membership.holds_face(region, {cell, direction}))
          continue;
        const double part = share * surfaces.open_part(cell, direction) * face_area;
        sites.for_points({cell, direction}, [&](Site particle) {
          Vec3& area = areas[body.at(particle)];
          area += part * face_normals[direction];
        });
      }
    }
  std::vector<OpenArea> found;
  found.reserve(areas.size());
  for (const auto& [particle, area] : areas) found.push_back({particle, area});
  return found;
}

}  // namespace hyperlattice
