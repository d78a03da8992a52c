// A cube is cut by few of a solid's surfaces, mostly by none. One surface cuts off a part whose
// volume has a closed form: planes exactly; a sphere or cylinder by its tangent plane and the
// volume between the two, the integral of the sag over the section of the plane. A mesh or an image
// knows its volume. Several surfaces cut the cube into convex pieces, each inside or outside as a
// whole. A cube is divided into eighths while a round surface in it bends too much for its tangent
// plane.
#include <geometry/convex_polyhedron.hpp>
#include <geometry/volume_share.hpp>

#include <algorithm>
#include <optional>

namespace hyperlattice {

namespace {

/// A surface, or a solid of many faces, that cuts a cube.
struct Cutter {
  const SolidSurface* surface = nullptr;
  const FacetedSolid* facets = nullptr;  ///< both null: a solid that is known by points only
  bool is_turned = false;                ///< whether the region lies on the outer side
};

/// Returns where a cube lies. If it is cut, appends what cuts it.
Side classify(const Region& region, const Cube& cube, bool is_turned,
              std::vector<Cutter>& cutters) {
  const std::size_t before = cutters.size();
  const auto decided = [&](Side side) {
    cutters.resize(before);
    return side;
  };
  if (region.kind == Region::Kind::solid) {
    if (region.facets) {
      const Side side = region.facets->side_of(cube);
      if (side == Side::cut) cutters.push_back({nullptr, region.facets.get(), is_turned});
      return side;
    }
    for (const SolidSurface& surface : region.surfaces) {
      const Side side = surface.side_of(cube);
      if (side == Side::outside) return decided(Side::outside);
      if (side == Side::cut) cutters.push_back({&surface, nullptr, is_turned});
    }
    if (region.surfaces.empty()) cutters.push_back({});
    return cutters.size() > before ? Side::cut : Side::inside;
  }
  // One part decides alone: an inner one in a union, an outer one in an intersection.
  const bool is_union = region.kind == Region::Kind::set_union;
  const Side alone = is_union ? Side::inside : Side::outside;
  for (std::size_t n = 0; n < region.parts.size(); ++n) {
    const bool removed = region.kind == Region::Kind::difference && n > 0;
    Side side = classify(*region.parts[n], cube, is_turned != removed, cutters);
    if (removed && side != Side::cut) side = side == Side::inside ? Side::outside : Side::inside;
    if (side == alone) return decided(alone);
  }
  if (cutters.size() > before) return Side::cut;
  return is_union ? Side::outside : Side::inside;
}

class Volume {
 public:
  explicit Volume(const Region& solid) : solid_(solid) {}

  /// Returns the volume of the solid in a cube, m3. `level`: how often it was divided.
  double in(const Cube& cube, int level) const {
    std::vector<Cutter> cutters;
    const Side side = classify(solid_, cube, false, cutters);
    if (side != Side::cut) return side == Side::inside ? cube.volume() : 0;
    if (is_one_round(cutters)) {
      if (cube.edge > flat * cutters.front().surface->radius && level < finest)
        return in_eighths(cube, level);
      return volume_of(cutters.front(), cube);
    }
    if (cutters.size() == 1 && is_known(cutters.front())) return volume_of(cutters.front(), cube);
    if (const auto planes = planes_of(cutters, cube, level))
      return inside(ConvexPolyhedron(cube), *planes);
    return in_eighths(cube, level);
  }

 private:
  // A tangent plane stands for a round surface in a cube below this part of the radius.
  static constexpr double flat = 1.0 / 16;
  // An edge between surfaces passes few cubes: at this level they are small enough for mere planes.
  static constexpr int fine = 4, finest = 8;
  static constexpr std::size_t most_planes = 12;

  double in_eighths(const Cube& cube, int level) const {
    double sum = 0;
    for (unsigned n = 0; n < 8; ++n) sum += in(cube.eighth(n), level + 1);
    return sum;
  }

  static bool is_known(const Cutter& cutter) {
    return cutter.surface != nullptr || cutter.facets != nullptr;
  }
  static bool is_one_round(const std::vector<Cutter>& cutters) {
    return cutters.size() == 1 && cutters.front().surface != nullptr &&
           !cutters.front().surface->is_plane();
  }

  /// Returns the volume on the region's side of the only cutter.
  static double volume_of(const Cutter& cutter, const Cube& cube) {
    const double inner = inner_volume(cutter, cube);
    return cutter.is_turned ? cube.volume() - inner : inner;
  }
  static double inner_volume(const Cutter& cutter, const Cube& cube) {
    if (cutter.facets != nullptr) return cutter.facets->volume_in(cube);
    const SolidSurface& surface = *cutter.surface;
    const auto parts = ConvexPolyhedron(cube).cut(surface.tangent(cube.centre()));
    double volume = parts.below.volume();
    // The rule of the edges' middles is exact for a sag of second order.
    for_triangles(parts.section, [&](Vec3 a, Vec3 b, Vec3 c) {
      const double area = 0.5 * norm(cross(b - a, c - a));
      volume -=
          area / 3 *
          (surface.sag(0.5 * (a + b)) + surface.sag(0.5 * (b + c)) + surface.sag(0.5 * (c + a)));
    });
    return std::clamp(volume, 0.0, cube.volume());
  }

  /// Returns planes that divide the cube into pieces inside and outside; nothing if the cube must
  /// be divided first.
  static std::optional<std::vector<Plane>> planes_of(const std::vector<Cutter>& cutters,
                                                     const Cube& cube, int level) {
    const bool must_end = level >= finest;
    std::vector<Plane> planes;
    for (const Cutter& cutter : cutters) {
      if (cutter.surface != nullptr) {
        const bool is_flat = cutter.surface->is_plane() ||
                             (level >= fine && cube.edge <= 3 * flat * cutter.surface->radius);
        if (!is_flat && !must_end) return std::nullopt;
        planes.push_back(cutter.surface->tangent(cube.centre()));
      } else if (cutter.facets != nullptr) {
        const auto faces = cutter.facets->planes_in(cube, most_planes);
        planes.insert(planes.end(), faces.begin(), faces.end());
      } else if (level <= fine) {
        return std::nullopt;
      }
      if (planes.size() > most_planes && level <= fine) return std::nullopt;
    }
    if (planes.size() > most_planes) planes.clear();  // the cube's middle decides
    return planes;
  }

  /// Returns the volume inside of a piece that the planes divide further, m3.
  double inside(const ConvexPolyhedron& piece, std::span<const Plane> planes) const {
    if (piece.empty()) return 0;
    if (planes.empty()) return solid_.contains(piece.middle()) ? piece.volume() : 0;
    const auto parts = piece.cut(planes.front());
    return inside(parts.below, planes.subspan(1)) + inside(parts.above, planes.subspan(1));
  }

  const Region& solid_;
};

}  // namespace

double volume_share(const Region& solid, const Cube& cube) {
  return std::clamp(Volume(solid).in(cube, 0) / cube.volume(), 0.0, 1.0);
}

}  // namespace hyperlattice
