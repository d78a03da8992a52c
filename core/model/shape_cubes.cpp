#include <model/shape_cubes.hpp>

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

}  // namespace

Body fill_with_cubes(const Body& body, const Nearby& nearby, double width) {
  const Cubes filled{body, nearby, width};
  return build_body(cubes_functions, &filled);
}

}  // namespace hyperlattice
