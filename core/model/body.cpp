#include <host/host.hpp>
#include <host/plugin_call.hpp>
#include <model/body.hpp>

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <utility>

namespace hyperlattice {

namespace {

/// Returns the site of a particle, given the runs.
Site site_in(std::span<const Run> runs, Particle particle) {
  const auto after = std::upper_bound(runs.begin(), runs.end(), particle,
                                      [](Particle p, const Run& run) { return p < run.first; });
  const Run& run = *(after - 1);
  return {run.begin + static_cast<std::int32_t>(particle - run.first), run.j, run.k};
}

/// Returns whether the neighbour follows the site in the order z, y, x.
bool is_forward(const Neighbour& n) {
  return n.dz != 0 ? n.dz > 0 : n.dy != 0 ? n.dy > 0 : n.dx > 0;
}

/// Positive and finite.
bool is_size(double value) { return value > 0 && std::isfinite(value); }

/// Receives the description of a lattice component. Throws std::invalid_argument for values that
/// would break the order or leave the box.
struct Builder {
  Body body;
  std::vector<PartialCell> partial;
  bool has_grid = false;

  void grid(const Grid& grid) {
    if (has_grid || body.is_listed())
      throw std::invalid_argument("the lattice gave two grids, or a grid and a list");
    if (!(is_size(grid.spacing) && is_size(grid.site_volume) && is_size(grid.membrane_distance)) ||
        *std::min_element(grid.sites.begin(), grid.sites.end()) < 1)
      throw std::invalid_argument("the lattice's box has no sites");
    if (grid.neighbours.size() > max_neighbours || grid.spring_classes < 1 ||
        grid.spring_classes > max_spring_classes)
      throw std::invalid_argument(
          "the lattice has more neighbours or spring classes than a kernel can hold");
    if (!(std::abs(dot(grid.basis[0], cross(grid.basis[1], grid.basis[2]))) > 1e-9))
      throw std::invalid_argument("the lattice's basis does not span space");
    if (!std::isfinite(grid.origin.x + grid.origin.y + grid.origin.z))
      throw std::invalid_argument("the lattice's origin is not finite");
    if (has_cells(grid.boundary) && grid.basis != cubic_basis)
      throw std::invalid_argument("the lattice has boundary cells and is not cubic");
    for (std::uint32_t c = 0; c < grid.spring_classes; ++c)
      if (!(grid.class_stiffness[c] > 0 && std::isfinite(grid.class_stiffness[c])))
        throw std::invalid_argument("the lattice has a class of springs without stiffness");
    body.grid = grid;
    body.neighbours.assign(grid.neighbours.begin(), grid.neighbours.end());
    body.grid.neighbours = body.neighbours;
    for (const Neighbour& n : body.neighbours) {
      if (!is_forward(n) || n.spring_class >= grid.spring_classes)
        throw std::invalid_argument("the lattice has a neighbour that does not follow its site");
      if (has_cells(grid.boundary) && std::max({std::abs(n.dx), std::abs(n.dy), n.dz}) > 1)
        throw std::invalid_argument(
            "the lattice has boundary cells and a spring that is longer than a cell");
      body.reach = std::max(body.reach, n.dz);
    }
    body.row_runs.reserve(row_count() + 1);
    has_grid = true;
  }

  void run(std::int32_t j, std::int32_t k, std::int32_t begin, std::int32_t end) {
    if (!has_grid) throw std::invalid_argument("the lattice gave particles before its grid");
    const auto& [nx, ny, nz] = body.grid.sites;
    const std::int32_t last = has_cells(body.grid.boundary) && body.cells.empty()
                                  ? 1
                                  : 0;  // a cell ends at the next site
    if (j < 0 || j >= ny - last || k < 0 || k >= nz - last || begin < 0 || end > nx - last ||
        begin >= end)
      throw std::invalid_argument("the lattice gave particles outside its box");
    const std::size_t row = row_of(j, k);
    if (row + 1 < body.row_runs.size() ||
        (row + 1 == body.row_runs.size() && begin < body.runs.back().end))
      throw std::invalid_argument("the lattice gave particles out of the order z, y, x");
    body.row_runs.resize(row + 1, body.runs.size());
    const bool first = body.runs.empty();
    body.low = first ? Site{begin, j, k}
                     : Site{std::min(body.low.i, begin), std::min(body.low.j, j), body.low.k};
    body.high = first ? Site{end - 1, j, k}
                      : Site{std::max(body.high.i, end - 1), std::max(body.high.j, j), k};
    body.runs.push_back({j, k, begin, end, body.particles});
    body.particles += static_cast<std::uint64_t>(end - begin);
  }

  void partial_run(std::int32_t j, std::int32_t k, std::int32_t begin,
                   std::span<const double> shares) {
    if (body.grid.boundary != Boundary::partial_cells)
      throw std::invalid_argument("the lattice gave shares of cells and has no partial cells");
    const Particle first = body.particles;
    run(j, k, begin, begin + static_cast<std::int32_t>(shares.size()));
    for (std::size_t n = 0; n < shares.size(); ++n) {
      const double share = smallest_share * std::round(shares[n] / smallest_share);
      if (!(share > 0 && share <= 1))
        throw std::invalid_argument(
            "the lattice gave a share of a cell that is not between 0 and 1");
      if (share < 1) partial.push_back({first + n, static_cast<float>(share)});
    }
  }

  void points(const PointList& points) {
    if (has_grid || body.is_listed())
      throw std::invalid_argument("the lattice gave two lists, or a grid and a list");
    body.listed = sorted(points);
    body.grid.spacing = points.spacing;
    body.grid.site_volume = points.site_volume;
    body.grid.membrane_distance = points.membrane_distance;
    body.grid.shape = points.shape;
    body.particles = body.listed.positions.size();
    body.springs[0] = body.listed.springs.size();
  }

  void sample(const PeriodicSample& sample) {
    if (!body.is_listed()) throw std::invalid_argument("the lattice gave a sample before its list");
    keep_sample(body.listed, sample);
  }

  void finish() {
    if (body.particles == 0) throw std::invalid_argument("the lattice has no particles");
    if (!body.is_listed()) {
      end_rows();
      if (has_cells(body.grid.boundary)) take_corners();
      count_springs();
    }
    find_box();
  }

 private:
  std::size_t row_count() const {
    return static_cast<std::size_t>(body.grid.sites[1]) *
           static_cast<std::size_t>(body.grid.sites[2]);
  }
  std::size_t row_of(std::int32_t j, std::int32_t k) const {
    return static_cast<std::size_t>(k) * static_cast<std::size_t>(body.grid.sites[1]) +
           static_cast<std::size_t>(j);
  }

  void find_box() {
    body.lowest = body.highest = body.position(Particle{0});
    const auto widen = [this](Vec3 x) {
      body.lowest = {std::min(body.lowest.x, x.x), std::min(body.lowest.y, x.y),
                     std::min(body.lowest.z, x.z)};
      body.highest = {std::max(body.highest.x, x.x), std::max(body.highest.y, x.y),
                      std::max(body.highest.z, x.z)};
    };
    for (const Vec3 x : body.listed.positions) widen(x);
    for (const Run& run : body.runs) {
      widen(body.position({run.begin, run.j, run.k}));
      widen(body.position({run.end - 1, run.j, run.k}));
    }
  }

  void end_rows() { body.row_runs.resize(row_count() + 1, body.runs.size()); }

  /// Converts the runs of cells to runs of their corners, the particles.
  void take_corners() {
    body.cells = Cells(std::exchange(body.runs, {}), std::exchange(body.row_runs, {}),
                       body.grid.sites[1], std::move(partial));
    body.particles = 0;
    for (std::int32_t k = 0; k < body.grid.sites[2]; ++k)
      for (std::int32_t j = 0; j < body.grid.sites[1]; ++j)
        for (const Range& range : body.cells.sites(j, k)) run(j, k, range.begin, range.end);
    end_rows();
  }

  void count_springs() {
    for (std::int32_t k = 0; k < body.grid.sites[2]; ++k)
      for (std::int32_t j = 0; j < body.grid.sites[1]; ++j)
        for (const Neighbour& n : body.neighbours)
          for (const Range& range : body.springs_of(j, k, n))
            body.springs[n.spring_class] += static_cast<std::uint64_t>(range.end - range.begin);
  }
};

}  // namespace

Site Body::site(Particle particle) const { return site_in(runs, particle); }

Vec3 Body::centre_of_cell(Particle cell) const {
  return position(site_in(cells.runs(), cell)) + 0.5 * grid.spacing * Vec3{1, 1, 1};
}

Particle Body::at(Site site) const {
  for (const Run& run : row(site.j, site.k))
    if (site.i < run.end)
      return site.i < run.begin ? no_particle
                                : run.first + static_cast<Particle>(site.i - run.begin);
  return no_particle;
}

std::span<const Run> Body::row(std::int32_t j, std::int32_t k) const {
  if (j < 0 || k < 0 || j >= grid.sites[1] || k >= grid.sites[2]) return {};
  const std::size_t row = static_cast<std::size_t>(k) * static_cast<std::size_t>(grid.sites[1]) +
                          static_cast<std::size_t>(j);
  return {runs.data() + row_runs[row], runs.data() + row_runs[row + 1]};
}

std::uint32_t Body::cut_of(Particle particle) const {
  const auto found =
      std::lower_bound(cut_sites.begin(), cut_sites.end(), particle,
                       [](const CutSite& cut, Particle wanted) { return cut.particle < wanted; });
  return found == cut_sites.end() || found->particle != particle ? 0 : found->neighbours;
}

std::uint64_t Body::cut_springs() const {
  std::uint64_t count = listed.cut.size();
  for (const CutSite& cut : cut_sites)
    count += static_cast<std::uint64_t>(std::popcount(cut.neighbours));
  return count;
}

void Body::take_away(std::vector<CutSite> cut) {
  std::sort(cut.begin(), cut.end(),
            [](const CutSite& a, const CutSite& b) { return a.particle < b.particle; });
  for (const CutSite& one : cut)
    if (!cut_sites.empty() && cut_sites.back().particle == one.particle)
      cut_sites.back().neighbours |= one.neighbours;
    else
      cut_sites.push_back(one);
  for (const CutSite& one : cut_sites)
    for (std::uint32_t n = 0; n < neighbours.size(); ++n)
      springs[neighbours[n].spring_class] -= one.neighbours >> n & 1U;
}

void Body::take_away(const std::vector<bool>& is_cut) {
  std::vector<ListedSpring> kept;
  kept.reserve(listed.springs.size());
  for (std::size_t n = 0; n < listed.springs.size(); ++n)
    (is_cut[n] ? listed.cut : kept).push_back(listed.springs[n]);
  listed.springs = std::move(kept);
  springs[0] = listed.springs.size();
}

std::vector<Range> Body::springs_of(std::int32_t j, std::int32_t k, const Neighbour& to) const {
  std::vector<Range> found = uncut_springs_of(j, k, to);
  if (cut_sites.empty()) return found;
  const auto bit = static_cast<std::uint32_t>(std::find_if(neighbours.begin(), neighbours.end(),
                                                           [&](const Neighbour& n) {
                                                             return n.dx == to.dx &&
                                                                    n.dy == to.dy && n.dz == to.dz;
                                                           }) -
                                              neighbours.begin());
  std::vector<Range> kept;
  for (const Run& run : row(j, k)) {
    auto cut =
        std::lower_bound(cut_sites.begin(), cut_sites.end(), run.first,
                         [](const CutSite& of, Particle wanted) { return of.particle < wanted; });
    const Particle end = run.first + static_cast<Particle>(run.end - run.begin);
    for (const Range& range : found) {
      Range rest{std::max(range.begin, run.begin), std::min(range.end, run.end)};
      for (; cut != cut_sites.end() && cut->particle < end; ++cut) {
        const std::int32_t i = run.begin + static_cast<std::int32_t>(cut->particle - run.first);
        if (i >= rest.end) break;
        if (i < rest.begin || (cut->neighbours >> bit & 1U) == 0) continue;
        if (rest.begin < i) kept.push_back({rest.begin, i});
        rest.begin = i + 1;
      }
      if (rest.begin < rest.end) kept.push_back(rest);
    }
  }
  return kept;
}

std::vector<Range> Body::uncut_springs_of(std::int32_t j, std::int32_t k,
                                          const Neighbour& to) const {
  if (!cells.empty()) return cells.sites(j, k, to);
  std::vector<Range> found;
  for (const Run& run : row(j, k))
    for (const Run& other : row(j + to.dy, k + to.dz)) {
      const Range common{std::max(run.begin, other.begin - to.dx),
                         std::min(run.end, other.end - to.dx)};
      if (common.begin < common.end) found.push_back(common);
    }
  return found;
}

Body build_body(const LatticeFunctions& functions, const void* lattice, bool for_analysis,
                const Component* component) {
  Builder builder;
  const LatticeSink sink{
      &builder,
      for_analysis,
      [](void* self, const Grid& grid) noexcept {
        PluginCall::answer([&] { static_cast<Builder*>(self)->grid(grid); });
      },
      [](void* self, std::int32_t j, std::int32_t k, std::int32_t begin,
         std::int32_t end) noexcept {
        PluginCall::answer([&] { static_cast<Builder*>(self)->run(j, k, begin, end); });
      },
      [](void* self, const PointList& points) noexcept {
        PluginCall::answer([&] { static_cast<Builder*>(self)->points(points); });
      },
      [](void* self, const PeriodicSample& sample) noexcept {
        PluginCall::answer([&] { static_cast<Builder*>(self)->sample(sample); });
      },
      [](void* self, std::int32_t j, std::int32_t k, std::int32_t begin,
         std::span<const double> shares) noexcept {
        PluginCall::answer([&] { static_cast<Builder*>(self)->partial_run(j, k, begin, shares); });
      }};
  const bool named = component != nullptr;
  PluginCall call(named ? component->info.name : std::string_view(),
                  named ? component->path.c_str() : "", "build");
  if (const std::string* sentence = call.failure(functions.build(lattice, sink, call.why())))
    throw std::invalid_argument(*sentence);
  builder.finish();
  return std::move(builder.body);
}

}  // namespace hyperlattice
