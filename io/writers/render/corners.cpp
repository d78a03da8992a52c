#include "corners.hpp"

#include "local_motion.hpp"

#include <bit>

namespace hyperlattice::render {

namespace {

constexpr std::uint64_t piece = 4096;  ///< corners of a task

/// Returns the deformation gradients of the particles that are needed, by their entries in
/// `needed`.
std::vector<Matrix> gradients(const DrawnBody& body, const std::vector<std::uint32_t>& entry,
                              std::size_t count) {
  const BodyGrid& grid = body.grid;
  std::vector<LocalMotion> motions(count);
  for (Place cube; cube.k < grid.count(2); ++cube.k)
    for (cube.j = 0; cube.j < grid.count(1); ++cube.j)
      for (cube.i = 0; cube.i < grid.count(0); ++cube.i) {
        const std::uint32_t a = grid.particle(cube);
        if (a == BodyGrid::none) continue;
        for (int axis = 0; axis < 3; ++axis) {
          const std::uint32_t b = grid.particle(cube.moved(axis, 1));
          if (b == BodyGrid::none || b == a) continue;
          const std::uint32_t at_a = entry[a], at_b = entry[b];
          if ((at_a == BodyGrid::none && at_b == BodyGrid::none) || !body.broken.joins(a, b))
            continue;
          const Vec3 rest = position_of(body.snapshot, b) - position_of(body.snapshot, a),
                     now = body.position(b) - body.position(a);
          if (at_a != BodyGrid::none) motions[at_a].add(rest, now);
          if (at_b != BodyGrid::none) motions[at_b].add(-rest, -now);
        }
      }
  std::vector<Matrix> all(count);
  body.snapshot.for_each((count + piece - 1) / piece, [&](std::uint64_t part) {
    for (std::size_t n = part * piece; n < std::min<std::size_t>(count, (part + 1) * piece); ++n)
      all[n] = motions[n].gradient();
  });
  return all;
}

}  // namespace

std::uint8_t Corners::cubes_with(Place corner, int n) const {
  std::uint32_t particles[8];
  bool any_broken = false;
  for (int cube = 0; cube < 8; ++cube) {
    particles[cube] = body_.grid.particle(cube_around(corner, cube));
    any_broken |= particles[cube] != BodyGrid::none && body_.broken.is_touched(particles[cube]);
  }
  unsigned found = 1U << n, before = 0;
  while (found != before) {
    before = found;
    for (int cube = 0; cube < 8; ++cube) {
      if ((found >> cube & 1U) == 0) continue;
      for (int step = 1; step < 8; step *= 2) {
        const int next = cube ^ step;
        if ((found >> next & 1U) != 0 || particles[next] == BodyGrid::none) continue;
        if (!any_broken || body_.broken.joins(particles[cube], particles[next]))
          found |= 1U << next;
      }
    }
  }
  return static_cast<std::uint8_t>(found);
}

std::uint32_t Corners::index(Place cube, int n) {
  const Place corner = corner_of(cube, n);
  const std::uint8_t cubes = cubes_with(corner, 7 - n);
  const std::uint64_t place = body_.grid.corner_index(corner);
  const auto lowest = static_cast<std::uint64_t>(std::countr_zero(cubes));
  const auto [at, is_new] =
      index_.try_emplace(8 * place + lowest, static_cast<std::uint32_t>(corners_.size()));
  if (is_new) corners_.push_back({place, cubes});
  return at->second;
}

std::vector<Vec3> Corners::places() const {
  const BodyGrid& grid = body_.grid;
  std::vector<std::uint32_t> entry(body_.snapshot.particles, BodyGrid::none);
  std::uint32_t needed = 0;
  const auto for_particles = [&](const Corner& corner, const auto& visit) {
    const Place place = grid.corner_place(corner.place);
    for (int n = 0; n < 8; ++n)
      if ((corner.cubes >> n & 1) != 0) visit(grid.particle(cube_around(place, n)));
  };
  for (const Corner& corner : corners_)
    for_particles(corner, [&](std::uint32_t particle) {
      if (entry[particle] == BodyGrid::none) entry[particle] = needed++;
    });
  const std::vector<Matrix> F = gradients(body_, entry, needed);
  std::vector<Vec3> places(corners_.size());
  body_.snapshot.for_each((places.size() + piece - 1) / piece, [&](std::uint64_t part) {
    const std::size_t end = std::min<std::size_t>(places.size(), (part + 1) * piece);
    for (std::size_t n = part * piece; n < end; ++n) {
      const Vec3 rest = body_.corners.at(grid, grid.corner_place(corners_[n].place));
      Vec3 sum;
      for_particles(corners_[n], [&](std::uint32_t particle) {
        sum += body_.position(particle) +
               F[entry[particle]] * (rest - position_of(body_.snapshot, particle));
      });
      places[n] = sum / std::popcount(corners_[n].cubes);
    }
  });
  return places;
}

}  // namespace hyperlattice::render
