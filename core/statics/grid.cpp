// The box of sites, and the weights of its springs and particles.
#include <statics/statics.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

constexpr std::int64_t vector_margin = lanes;  // kernels read whole vectors

}  // namespace

std::int64_t Statics::place_of(Particle particle) const {
  if (problem_.grid.listed) return static_cast<std::int64_t>(particle);
  const Site site = model_.body.site(particle), low = model_.body.low;
  return problem_.grid.place(site.i - low.i, site.j - low.j, site.k - low.k);
}

void Statics::make_grid() {
  const Body& body = model_.body;
  StaticGrid& grid = problem_.grid;
  grid.sites = {body.high.i - body.low.i + 1, body.high.j - body.low.j + 1,
                body.high.k - body.low.k + 1};
  std::int32_t reach[3] = {};
  for (const Neighbour& n : body.neighbours) {
    reach[0] = std::max(reach[0], std::abs(n.dx));
    reach[1] = std::max(reach[1], std::abs(n.dy));
    reach[2] = std::max(reach[2], std::abs(n.dz));
  }
  // The margin after a row is the one before the next row; kernels read beyond it by a vector.
  grid.row = std::max(grid.sites[0] + reach[0], lanes);
  // The plane is longer by a vector than its last row's margin: a kernel that reads beyond it would
  // otherwise meet another thread, which adds to the plane after.
  grid.plane = grid.row * (grid.sites[1] + reach[1]) + lanes;
  grid.origin = reach[0] + reach[1] * grid.row + reach[2] * grid.plane;
  grid.places = grid.place(grid.sites[0] - 1, grid.sites[1] - 1, grid.sites[2] - 1) + grid.origin +
                vector_margin;
  grid.components = model_.degrees_of_freedom;
  grid.spacing = body.grid.spacing;
  grid.membrane_distance = body.grid.membrane_distance;
  grid.neighbours = model_.springs.neighbours;

  rows_.assign(static_cast<std::size_t>(grid.sites[1]) * static_cast<std::size_t>(grid.sites[2]),
               {});
  free_.assign(static_cast<std::size_t>(grid.places), 0);
  for (const Run& run : body.runs) {
    StaticRow& row = rows_[static_cast<std::size_t>(run.k - body.low.k) *
                               static_cast<std::size_t>(grid.sites[1]) +
                           static_cast<std::size_t>(run.j - body.low.j)];
    if (row.begin == row.end) row.begin = run.begin - body.low.i;
    row.end = run.end - body.low.i;
  }
  const auto all = static_cast<std::uint8_t>((1u << grid.components) - 1);
  for_runs([&](std::int64_t place, Particle, std::uint64_t count) {
    std::fill_n(free_.begin() + place, count, all);
  });
  grid.rows = rows_;
  grid.free = free_.data();
}

void Statics::make_weights() {
  const Body& body = model_.body;
  const auto places = static_cast<std::size_t>(problem_.grid.places);
  weight_.assign(body.neighbours.size() * places, 0);
  particle_weight_.assign(places, 0);
  if (model_.materials.size() > 1) kind_.assign(places, 0);
  std::vector<std::uint16_t> alive;
  simulation_.alive(alive);
  make_cells(alive);
  for (const Run& run : body.runs)
    for (std::int32_t i = run.begin; i < run.end; ++i) {
      const Site site{i, run.j, run.k};
      const Particle particle = run.first + static_cast<Particle>(i - run.begin);
      const auto place = static_cast<std::size_t>(
          problem_.grid.place(i - body.low.i, run.j - body.low.j, run.k - body.low.k));
      particle_weight_[place] = static_cast<float>(body.share(site));
      if (!kind_.empty()) kind_[place] = model_.kinds.of(particle);
      for (std::size_t n = 0; n < body.neighbours.size(); ++n)
        if ((alive[particle] >> n & 1u) != 0)
          weight_[n * places + place] = static_cast<float>(body.share(site, body.neighbours[n]));
    }
}

void Statics::read_state(double* field) const {
  std::vector<double> xyz, heights;
  simulation_.displacements(xyz);
  simulation_.heights(heights);
  const auto places = static_cast<std::size_t>(problem_.grid.places);
  for_runs([&](std::int64_t first, Particle particle, std::uint64_t count) {
    for (std::uint64_t n = 0; n < count; ++n) {
      const std::size_t place = static_cast<std::size_t>(first) + n;
      for (std::size_t c = 0; c < 3; ++c) field[c * places + place] = xyz[3 * (particle + n) + c];
      if (!heights.empty()) field[3 * places + place] = heights[particle + n];
    }
  });
}

std::vector<double> Statics::of_particles(const double* field, int first, int components) const {
  const auto places = static_cast<std::size_t>(problem_.grid.places),
             number = static_cast<std::size_t>(components);
  std::vector<double> values(number * model_.body.particles);
  for_runs([&](std::int64_t place, Particle particle, std::uint64_t count) {
    for (std::uint64_t n = 0; n < count; ++n)
      for (std::size_t c = 0; c < number; ++c)
        values[number * (particle + n) + c] = field[(static_cast<std::size_t>(first) + c) * places +
                                                    static_cast<std::size_t>(place) + n];
  });
  return values;
}

}  // namespace hyperlattice
