#include <state/cell_stress.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

namespace {

/// One of the springs of a cell: from corner a to corner b.
struct CellSpring {
  std::size_t a = 0, b = 0;
  std::uint32_t neighbour = 0;
  double share = 0;  ///< part of the whole spring that belongs to one cell
};

std::vector<CellSpring> springs_of_cell(const Body& body) {
  std::vector<CellSpring> found;
  for (std::size_t a = 0; a < 8; ++a)
    for (std::uint32_t n = 0; n < body.neighbours.size(); ++n) {
      const Neighbour& to = body.neighbours[n];
      const std::int32_t i = static_cast<std::int32_t>(a & 1U) + to.dx,
                         j = static_cast<std::int32_t>(a >> 1 & 1U) + to.dy,
                         k = static_cast<std::int32_t>(a >> 2 & 1U) + to.dz;
      if (std::min({i, j, k}) < 0 || std::max({i, j, k}) > 1) continue;
      int cells = 0;
      for_cells_of(to, [&](int, int, int) { ++cells; });
      found.push_back({a, static_cast<std::size_t>(i + 2 * j + 4 * k), n, 1.0 / cells});
    }
  return found;
}

/// Consecutive cells of a row, and the first particle on each of the four lines of their corners,
/// y first.
struct CellRun {
  std::int32_t begin = 0, end = 0;
  std::array<Particle, 4> first{};
};

/// Returns the parts of ranges that lie in others too; both ascend.
std::vector<Range> common(std::span<const Range> a, std::span<const Range> b) {
  std::vector<Range> found;
  for (std::size_t m = 0, n = 0; m < a.size() && n < b.size();) {
    const Range both{std::max(a[m].begin, b[n].begin), std::min(a[m].end, b[n].end)};
    if (both.begin < both.end) found.push_back(both);
    ++(a[m].end < b[n].end ? m : n);
  }
  return found;
}

/// Returns the sites i of a row of which i + 1 has a particle too.
std::vector<Range> pairs_of_row(const Body& body, std::int32_t j, std::int32_t k) {
  std::vector<Range> found;
  for (const Run& run : body.row(j, k)) {
    if (!found.empty() && found.back().end + 1 == run.begin)
      found.back().end = run.end - 1;  // a run that follows without a gap
    else
      found.push_back({run.begin, run.end - 1});
  }
  return found;
}

std::vector<CellRun> cells_of_row(const Body& body, std::int32_t j, std::int32_t k) {
  std::vector<Range> cells;
  if (body.cells.empty()) {
    cells = pairs_of_row(body, j, k);
    for (std::int32_t line = 1; line < 4; ++line)
      cells = common(cells, pairs_of_row(body, j + line % 2, k + line / 2));
  } else {
    for (const Run& run : body.cells.row(j, k)) cells.push_back({run.begin, run.end});
  }
  std::vector<CellRun> found;
  for (const Range& range : cells) {
    if (range.begin >= range.end) continue;
    CellRun run{range.begin, range.end, {}};
    for (std::int32_t line = 0; line < 4; ++line)
      run.first[static_cast<std::size_t>(line)] =
          body.at({range.begin, j + line % 2, k + line / 2});
    found.push_back(run);
  }
  return found;
}

/// The cells of one layer, between the planes k and k + 1.
class Layer {
 public:
  Layer(const PresentSprings& springs, Asked asked, std::span<const CellSpring> springs_of_cell,
        std::int32_t k)
      : springs_(springs),
        model_(springs.model()),
        asked_(asked),
        springs_of_cell_(springs_of_cell),
        k_(k),
        planes_{springs.plane(k, asked), springs.plane(k + 1, asked, in_plane())} {}

  void visit(const std::function<void(const PresentCell&)>& visit) const {
    const Body& body = model_.body;
    PresentCell cell;
    for (std::int32_t j = body.low.j; j < body.high.j; ++j)
      for (const CellRun& run : cells_of_row(body, j, k_))
        for (std::int32_t i = run.begin; i < run.end; ++i) {
          cell.site = {i, j, k_};
          for (std::size_t corner = 0; corner < 8; ++corner)
            cell.corners[corner] =
                run.first[corner >> 1] + static_cast<Particle>(i - run.begin) + (corner & 1U);
          fill(cell);
          visit(cell);
        }
  }

 private:
  /// Returns the bits of the neighbours in the same plane.
  std::uint32_t in_plane() const {
    std::uint32_t bits = 0;
    for (std::uint32_t n = 0; n < model_.body.neighbours.size(); ++n)
      if (model_.body.neighbours[n].dz == 0) bits |= 1U << n;
    return bits;
  }

  void fill(PresentCell& cell) const {
    const Mixtures& mixtures = model_.kinds.mixtures;
    cell.material = mixtures.empty() ? model_.kinds.material(cell.corners[0])
                                     : mixtures.cell_above(mixtures.of(cell.corners[0]));
    if (model_.body.cells.has_partial()) cell.share = model_.body.cells.share_of_cell(cell.site);
    const Vec3 first = springs_.displacement(cell.corners[0]);
    for (std::size_t n = 0; n < 8; ++n)
      cell.moved[n] = springs_.displacement(cell.corners[n]) - first;
    cell.gradient = gradient_in(cell, springs_.displacements(), model_.body.grid.spacing);
    cell.is_whole = std::all_of(
        springs_of_cell_.begin(), springs_of_cell_.end(),
        [&](const CellSpring& of) { return springs_.lives(cell.corners[of.a], of.neighbour); });
    cell.has_volumetric_energy = springs_.has_volumetric_energy(cell.corners[0]);
    cell.remaining_tension = springs_.remaining_tension(cell.corners[0]);
    cell.force = {};
    cell.energy = 0;
    if (asked_ == Asked::motion) return;
    for (const CellSpring& of : springs_of_cell_) add_spring(of, cell);
    if (asked_ == Asked::energies) add_alpha(cell);
    add_volumetric_energy(model_, cell);
  }

  void add_spring(const CellSpring& of, PresentCell& cell) const {
    const Particle a = cell.corners[of.a];
    const PlaneSprings& plane = planes_[of.a >> 2];
    const std::size_t at = plane.index(of.neighbour, a);
    SpringPull whole{plane.pull[at], asked_ == Asked::energies ? plane.energy[at] : 0.0};
    if (is_mixed(a, of.neighbour, cell.material))
      whole = springs_.part_of(a, cell.corners[of.b], of.neighbour, cell.material);
    const double part = cell.share * of.share;
    const Vec3 force =
        part * whole.pull *
        (model_.springs.neighbours[of.neighbour].rest + (cell.moved[of.b] - cell.moved[of.a]));
    cell.force[of.a] += force;
    cell.force[of.b] -= force;
    cell.energy += part * whole.energy;
  }

  /// Returns whether a spring has parts of other cells' materials, so that the cell's own part is
  /// not the spring's mean.
  bool is_mixed(Particle a, std::uint32_t neighbour, std::uint8_t material) const {
    if (model_.kinds.mixtures.empty()) return false;
    const std::uint32_t mixture = model_.kinds.mixtures.of(a);
    return mixture >= model_.materials.size() &&
           &model_.springs.spring_to(neighbour, mixture, mixture) !=
               &model_.springs.spring(material, material,
                                      model_.body.neighbours[neighbour].spring_class);
  }

  /// Adds an eighth of the energy of each corner's alpha spring, of length Delta + 2 h.
  void add_alpha(PresentCell& cell) const {
    if (model_.degrees_of_freedom != 4) return;
    for (const Particle corner : cell.corners) {
      const double height = springs_.height(corner);
      const std::uint32_t kind =
          model_.kinds.mixtures.empty() ? model_.kinds.of(corner) : cell.material;
      cell.energy += cell.share / 8 * springs_.remaining_alpha(corner) * model_.kinds.alphas[kind] *
                     height * height;
    }
  }

  const PresentSprings& springs_;
  const Model& model_;
  const Asked asked_;
  const std::span<const CellSpring> springs_of_cell_;
  const std::int32_t k_;
  const PlaneSprings planes_[2];
};

double cube(double x) { return x * x * x; }

}  // namespace

bool has_cells(const Body& body) {
  return body.is_cubic() &&
         std::all_of(body.neighbours.begin(), body.neighbours.end(), [](const Neighbour& to) {
           return std::max({std::abs(to.dx), std::abs(to.dy), std::abs(to.dz)}) <= 1;
         });
}

Tensor gradient_in(const PresentCell& cell, std::span<const double> xyz, double spacing) {
  Tensor sum;
  for (std::size_t c = 0; c < 3; ++c) {
    // Differences along the edges, so that a rigid motion cancels before anything is added.
    double v[8];
    for (std::size_t n = 0; n < 8; ++n) v[n] = xyz[3 * cell.corners[n] + c];
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t n = 0; n < 8; ++n)
        if ((n >> axis & 1U) == 0) sum[c][axis] += v[n | std::size_t{1} << axis] - v[n];
  }
  return 1 / (4 * spacing) * sum;
}

void add_volumetric_energy(const Model& model, PresentCell& cell) {
  if (!cell.has_volumetric_energy) return;
  const CellResponse own = soften(
      cell_response(cell.moved, model.body.grid.spacing, model.volumetric.modulus(cell.site)),
      cell.remaining_tension);
  for (std::size_t n = 0; n < 8; ++n) cell.force[n] += own.force[n];
  cell.energy += own.energy;
}

void for_cells(const PresentSprings& springs, Asked asked, std::int32_t low, std::int32_t high,
               const std::function<void(const PresentCell&)>& visit) {
  const Body& body = springs.model().body;
  if (!has_cells(body)) return;
  const std::int32_t first = std::max(low, body.low.k), end = std::min(high, body.high.k);
  const std::vector<CellSpring> of_cell = springs_of_cell(body);
  // A layer has its corners in two planes, so that every second layer is computed at a time. A sum
  // over the cells of a corner has the order of k modulo 2 in the body, whatever the layers asked
  // for.
  for (const std::int32_t colour : {0, 1}) {
    const std::int32_t start = first + ((first ^ colour) & 1);
    if (start >= end) continue;
    springs.simulation().in_parallel(
        static_cast<std::size_t>((end - start + 1) / 2), [&](std::size_t n) {
          Layer(springs, asked, of_cell, start + 2 * static_cast<std::int32_t>(n)).visit(visit);
        });
  }
}

void for_cells(const PresentSprings& springs, Asked asked,
               const std::function<void(const PresentCell&)>& visit) {
  const Body& body = springs.model().body;
  if (!body.is_listed()) for_cells(springs, asked, body.low.k, body.high.k, visit);
}

Tensor nominal_stress(const PresentCell& cell, double spacing) {
  Tensor sum;
  for (std::size_t n = 0; n < 8; ++n)
    sum += outer(cell.force[n], {corner_sign(n, 0), corner_sign(n, 1), corner_sign(n, 2)});
  return -1 / (2 * cell.share * spacing * spacing) * sum;
}

std::optional<Tensor> cauchy_stress(const PresentCell& cell, double spacing) {
  const double J = cell.is_whole ? 1 + volume_change(cell.gradient) : 1;
  if (!(J > 0)) return std::nullopt;
  Tensor sum = cell.share * cube(spacing) * nominal_stress(cell, spacing);
  for (std::size_t n = 0; n < 8; ++n) sum += -1 * outer(cell.force[n], cell.moved[n]);
  return 1 / (J * cell.share * cube(spacing)) * sum;
}

double energy_density(const PresentCell& cell, double spacing) {
  return cell.energy / (cell.share * cube(spacing));
}

}  // namespace hyperlattice
