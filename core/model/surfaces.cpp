// Which faces of which particles are open, and which particles a region means.
#include <model/body.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

constexpr std::array<Site, 6> steps{{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};  // as face_normals

Site beside(Site site, std::size_t face) { return {site.i + steps[face].i, site.j + steps[face].j, site.k + steps[face].k}; }

/// A particle with what regions ask about.
struct Place {
  Site site;
  Vec3 position;
};

/// Answers for one body what regions mean.
struct Reader {
  const Body& body;
  const Surfaces& surfaces;

  bool holds(const Region& region, const Place& place) const {
    const auto part_holds = [&](const auto& part) { return holds(*part, place); };
    switch (region.kind) {
      case Region::Kind::all:
        return true;
      case Region::Kind::solid:
        return region.inside(place.position);
      case Region::Kind::surface:
      case Region::Kind::inner_surface:
      case Region::Kind::outer_surface:
        return faces(region, place) != 0;
      case Region::Kind::face:
        return is_outermost(place.site, region.direction);
      case Region::Kind::set_union:
        return std::any_of(region.parts.begin(), region.parts.end(), part_holds);
      case Region::Kind::intersection:
        return std::all_of(region.parts.begin(), region.parts.end(), part_holds);
      case Region::Kind::difference:
        return part_holds(region.parts.front()) && std::none_of(region.parts.begin() + 1, region.parts.end(), part_holds);
    }
    return false;
  }

  ExposedFaces faces(const Region& region, const Place& place) const {
    switch (region.kind) {
      case Region::Kind::all:
      case Region::Kind::solid:
      case Region::Kind::surface:
        return surfaces.faces(place.site);
      case Region::Kind::inner_surface:
        return surfaces.inner_faces(place.site);
      case Region::Kind::outer_surface:
        return surfaces.outer_faces(place.site);
      case Region::Kind::face:
        return surfaces.faces(place.site) & 1U << region.direction;
      case Region::Kind::difference:
        return faces(*region.parts.front(), place);
      case Region::Kind::set_union: {
        ExposedFaces open = 0;
        for (const auto& part : region.parts)
          if (holds(*part, place)) open |= faces(*part, place);
        return open;
      }
      case Region::Kind::intersection: {
        ExposedFaces open = ~0U;
        for (const auto& part : region.parts) open &= faces(*part, place);
        return open;
      }
    }
    return 0;
  }

  bool is_outermost(Site site, int direction) const {
    switch (direction) {
      case 0:
        return site.i == body.low.i;
      case 1:
        return site.i == body.high.i;
      case 2:
        return site.j == body.low.j;
      case 3:
        return site.j == body.high.j;
      case 4:
        return site.k == body.low.k;
      default:
        return site.k == body.high.k;
    }
  }
};

}  // namespace

Surfaces::Surfaces(const Body& body)
    : body_(body), widened_{body.grid.sites[0] + std::int64_t{2}, body.grid.sites[1] + std::int64_t{2}, body.grid.sites[2] + std::int64_t{2}} {
  const auto [nx, ny, nz] = widened_;
  const auto size = static_cast<std::size_t>(nx * ny * nz);
  std::vector<bool> blocked(size);  // a particle, or reached by the flood
  for (const Run& run : body.runs) {
    const auto row = static_cast<std::size_t>(((run.k + 1) * ny + run.j + 1) * nx + 1);
    std::fill(blocked.begin() + static_cast<std::ptrdiff_t>(row) + run.begin, blocked.begin() + static_cast<std::ptrdiff_t>(row) + run.end, true);
  }
  outside_.assign(size, false);
  std::vector<std::int64_t> front{0};  // a corner of the widened box is outside
  blocked[0] = outside_[0] = true;
  while (!front.empty()) {
    const std::int64_t here = front.back();
    front.pop_back();
    const std::int64_t i = here % nx, j = here / nx % ny, k = here / (nx * ny);
    const auto reach = [&](bool inside_box, std::int64_t place) {
      if (!inside_box || blocked[static_cast<std::size_t>(place)]) return;
      blocked[static_cast<std::size_t>(place)] = outside_[static_cast<std::size_t>(place)] = true;
      front.push_back(place);
    };
    reach(i > 0, here - 1);
    reach(i + 1 < nx, here + 1);
    reach(j > 0, here - nx);
    reach(j + 1 < ny, here + nx);
    reach(k > 0, here - nx * ny);
    reach(k + 1 < nz, here + nx * ny);
  }
}

bool Surfaces::is_outside(Site site) const {
  return outside_[static_cast<std::size_t>(((site.k + 1) * widened_[1] + site.j + 1) * widened_[0] + site.i + 1)];
}

ExposedFaces Surfaces::faces(Site particle) const {
  ExposedFaces open = 0;
  for (std::size_t face = 0; face < 6; ++face)
    if (body_.at(beside(particle, face)) == Body::no_particle) open |= 1U << face;
  return open;
}

ExposedFaces Surfaces::outer_faces(Site particle) const {
  ExposedFaces open = 0;
  for (std::size_t face = 0; face < 6; ++face)
    if (is_outside(beside(particle, face))) open |= 1U << face;
  return open;
}

ExposedFaces Surfaces::inner_faces(Site particle) const { return faces(particle) & ~outer_faces(particle); }

std::vector<Particle> particles_in(const Body& body, const Surfaces& surfaces, const Region& region) {
  const Reader reader{body, surfaces};
  std::vector<Particle> found;
  for (const Run& run : body.runs)
    for (std::int32_t i = run.begin; i < run.end; ++i) {
      const Site site{i, run.j, run.k};
      if (reader.holds(region, {site, body.position(site)})) found.push_back(run.first + static_cast<Particle>(i - run.begin));
    }
  return found;
}

ExposedFaces open_faces(const Body& body, const Surfaces& surfaces, const Region& region, Particle particle) {
  const Site site = body.site(particle);
  return Reader{body, surfaces}.faces(region, {site, body.position(site)});
}

}  // namespace hyperlattice
