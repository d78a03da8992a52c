#include <model/body.hpp>

#include <algorithm>
#include <stdexcept>

namespace hyperlattice {

namespace {

/// Follows (dx, dy, dz) in the order z, y, x.
bool is_forward(const Neighbour& n) { return n.dz != 0 ? n.dz > 0 : n.dy != 0 ? n.dy > 0 : n.dx > 0; }

/// Takes what a lattice component describes, and refuses what would break the order or the box.
struct Builder {
  Body body;
  bool has_grid = false;

  void grid(const Grid& grid) {
    if (has_grid) throw std::invalid_argument("the lattice gave two grids");
    if (!(grid.spacing > 0 && grid.site_volume > 0 && grid.membrane_distance > 0) || *std::min_element(grid.sites.begin(), grid.sites.end()) < 1)
      throw std::invalid_argument("the lattice's box has no sites");
    if (grid.neighbours.size() > max_neighbours || grid.spring_classes < 1 || grid.spring_classes > max_spring_classes)
      throw std::invalid_argument("the lattice has more neighbours or spring classes than a kernel can hold");
    body.grid = grid;
    body.neighbours.assign(grid.neighbours.begin(), grid.neighbours.end());
    body.grid.neighbours = body.neighbours;
    for (const Neighbour& n : body.neighbours) {
      if (!is_forward(n) || n.spring_class >= grid.spring_classes)
        throw std::invalid_argument("the lattice has a neighbour that does not follow its site");
      body.reach = std::max(body.reach, n.dz);
    }
    body.row_runs.reserve(row_count() + 1);
    has_grid = true;
  }

  void run(std::int32_t j, std::int32_t k, std::int32_t begin, std::int32_t end) {
    if (!has_grid) throw std::invalid_argument("the lattice gave particles before its grid");
    const auto& [nx, ny, nz] = body.grid.sites;
    if (j < 0 || j >= ny || k < 0 || k >= nz || begin < 0 || end > nx || begin >= end)
      throw std::invalid_argument("the lattice gave particles outside its box");
    const std::size_t row = row_of(j, k);
    if (row + 1 < body.row_runs.size() || (row + 1 == body.row_runs.size() && begin < body.runs.back().end))
      throw std::invalid_argument("the lattice gave particles out of the order z, y, x");
    body.row_runs.resize(row + 1, body.runs.size());
    const bool first = body.runs.empty();
    body.low = first ? Site{begin, j, k} : Site{std::min(body.low.i, begin), std::min(body.low.j, j), body.low.k};
    body.high = first ? Site{end - 1, j, k} : Site{std::max(body.high.i, end - 1), std::max(body.high.j, j), k};
    body.runs.push_back({j, k, begin, end, body.particles});
    body.particles += static_cast<std::uint64_t>(end - begin);
  }

  void finish() {
    if (body.particles == 0) throw std::invalid_argument("the lattice has no particles");
    body.row_runs.resize(row_count() + 1, body.runs.size());
    count_springs();
  }

 private:
  std::size_t row_count() const { return static_cast<std::size_t>(body.grid.sites[1]) * static_cast<std::size_t>(body.grid.sites[2]); }
  std::size_t row_of(std::int32_t j, std::int32_t k) const {
    return static_cast<std::size_t>(k) * static_cast<std::size_t>(body.grid.sites[1]) + static_cast<std::size_t>(j);
  }

  /// A run has as many springs to a neighbour as its sites, shifted, have in common with the runs of the neighbour's row.
  void count_springs() {
    for (const Run& run : body.runs)
      for (const Neighbour& n : body.neighbours) {
        const std::int32_t j = run.j + n.dy, k = run.k + n.dz;
        if (j < 0 || j >= body.grid.sites[1] || k >= body.grid.sites[2]) continue;
        for (std::size_t other = body.row_runs[row_of(j, k)]; other < body.row_runs[row_of(j, k) + 1]; ++other) {
          const std::int32_t common = std::min(run.end + n.dx, body.runs[other].end) - std::max(run.begin + n.dx, body.runs[other].begin);
          if (common > 0) body.springs[n.spring_class] += static_cast<std::uint64_t>(common);
        }
      }
  }
};

}  // namespace

Site Body::site(Particle particle) const {
  const auto after = std::upper_bound(runs.begin(), runs.end(), particle, [](Particle p, const Run& run) { return p < run.first; });
  const Run& run = *(after - 1);
  return {run.begin + static_cast<std::int32_t>(particle - run.first), run.j, run.k};
}

Particle Body::at(Site site) const {
  if (site.j < 0 || site.j >= grid.sites[1] || site.k < 0 || site.k >= grid.sites[2]) return no_particle;
  const std::size_t row = static_cast<std::size_t>(site.k) * static_cast<std::size_t>(grid.sites[1]) + static_cast<std::size_t>(site.j);
  for (std::size_t n = row_runs[row]; n < row_runs[row + 1]; ++n)
    if (site.i < runs[n].end) return site.i < runs[n].begin ? no_particle : runs[n].first + static_cast<Particle>(site.i - runs[n].begin);
  return no_particle;
}

Body build_body(const LatticeFunctions& functions, const void* lattice) {
  Builder builder;
  const LatticeSink sink{
      &builder, [](void* self, const Grid& grid) { static_cast<Builder*>(self)->grid(grid); },
      [](void* self, std::int32_t j, std::int32_t k, std::int32_t begin, std::int32_t end) { static_cast<Builder*>(self)->run(j, k, begin, end); }};
  std::string sentence;
  const Complaint why{&sentence, [](void* self, std::string_view text) noexcept { *static_cast<std::string*>(self) = text; }};
  if (!functions.build(lattice, sink, why)) throw std::invalid_argument(sentence);
  builder.finish();
  return std::move(builder.body);
}

}  // namespace hyperlattice
