#include <model/body_cubes.hpp>
#include <model/shape_cubes.hpp>

#include <stdexcept>

namespace hyperlattice {

namespace {

constexpr double least_share = 0.5;  ///< of a partial cell that is drawn

CubeGrid empty_grid(Vec3 origin, double edge, std::int32_t nx, std::int32_t ny, std::int32_t nz) {
  const double cubes = static_cast<double>(nx) * ny * nz;
  if (!(cubes < static_cast<double>(BodyCubes::no_particle)))
    throw std::length_error("the body has too many particles for a picture");
  CubeGrid grid{origin, edge, {nx, ny, nz}, {}};
  grid.particle.assign(static_cast<std::size_t>(cubes), BodyCubes::no_particle);
  return grid;
}

std::size_t index_in(const CubeGrid& grid, std::int32_t i, std::int32_t j, std::int32_t k) {
  const auto nx = static_cast<std::size_t>(grid.count[0]),
             ny = static_cast<std::size_t>(grid.count[1]);
  return (static_cast<std::size_t>(k) * ny + static_cast<std::size_t>(j)) * nx +
         static_cast<std::size_t>(i);
}

/// Calls visit(site, index) for each site of a body's runs.
template <class Visit>
void for_sites(std::span<const Run> runs, const Visit& visit) {
  Particle index = 0;
  for (const Run& run : runs)
    for (Site site{run.begin, run.j, run.k}; site.i < run.end; ++site.i) visit(site, index++);
}

CubeGrid cells_of_particles(const Body& body) {
  const double edge = body.grid.spacing;
  const Site low = body.low, high = body.high;
  CubeGrid grid = empty_grid(body.position(low) - Vec3{edge / 2, edge / 2, edge / 2}, edge,
                             high.i - low.i + 1, high.j - low.j + 1, high.k - low.k + 1);
  for_sites(body.runs, [&](Site site, Particle particle) {
    grid.particle[index_in(grid, site.i - low.i, site.j - low.j, site.k - low.k)] =
        static_cast<std::uint32_t>(particle);
  });
  return grid;
}

CubeGrid eighths_of_cells(const Body& body) {
  const Site low = body.low, high = body.high;
  CubeGrid grid = empty_grid(body.position(low), body.grid.spacing / 2, 2 * (high.i - low.i),
                             2 * (high.j - low.j), 2 * (high.k - low.k));
  for_sites(body.cells.runs(), [&](Site cell, Particle index) {
    if (body.cells.share_of_cell(index) < least_share) return;
    for (std::int32_t corner = 0; corner < 8; ++corner) {
      const std::int32_t di = corner & 1, dj = corner >> 1 & 1, dk = corner >> 2;
      grid.particle[index_in(grid, 2 * (cell.i - low.i) + di, 2 * (cell.j - low.j) + dj,
                             2 * (cell.k - low.k) + dk)] =
          static_cast<std::uint32_t>(body.at({cell.i + di, cell.j + dj, cell.k + dk}));
    }
  });
  return grid;
}

CubeGrid cubes_in_shape(const Body& body) {
  const Nearby nearby(body);
  const Body cubes = fill_with_cubes(body, nearby, body.grid.spacing / 2);
  CubeGrid grid = cells_of_particles(cubes);
  for_sites(cubes.runs, [&](Site cube, Particle) {
    const Site low = cubes.low;
    grid.particle[index_in(grid, cube.i - low.i, cube.j - low.j, cube.k - low.k)] =
        static_cast<std::uint32_t>(nearby.nearest(cubes.position(cube)).particle);
  });
  return grid;
}

}  // namespace

BodyCubes CubeGrid::view() const {
  return {origin, edge, {count[0], count[1], count[2]}, particle};
}

CubeGrid cubes_of(const Body& body) {
  if (body.particles >= BodyCubes::no_particle)
    throw std::length_error("the body has too many particles for a picture");
  if (!body.is_cubic()) return cubes_in_shape(body);
  return body.cells.empty() ? cells_of_particles(body) : eighths_of_cells(body);
}

}  // namespace hyperlattice
