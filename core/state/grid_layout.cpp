#include <base/errors.hpp>
#include <state/block.hpp>
#include <state/grid_layout.hpp>

#include <algorithm>
#include <limits>

namespace hyperlattice {
namespace {

/// Returns the one material of all springs of a row, or -1 if there are several. In a body of cells
/// the row's mixtures decide, else the materials of its particles and of their neighbours.
std::int32_t material_of_row(const Model& model, std::int32_t j, std::int32_t k) {
  if (model.materials.size() == 1) return 0;
  std::int32_t found = -2;
  const auto look = [&](std::span<const Run> runs) {
    for (const Run& run : runs)
      for (std::int32_t i = run.begin; i < run.end; ++i) {
        const auto kind = static_cast<std::int32_t>(
            model.kinds.of(run.first + static_cast<Particle>(i - run.begin)));
        if (found != -2 && found != kind) return false;
        found = kind;
      }
    return true;
  };
  if (!look(model.body.row(j, k)) || found >= static_cast<std::int32_t>(model.materials.size()))
    return -1;
  if (!model.kinds.mixtures.empty()) return found;
  for (const Neighbour& to : model.body.neighbours)
    if (!look(model.body.row(j + to.dy, k + to.dz))) return -1;
  return found;
}

std::vector<std::uint64_t> particles_per_plane(const Body& body) {
  std::vector<std::uint64_t> counts(static_cast<std::size_t>(body.grid.sites[2]), 0);
  for (const Run& run : body.runs)
    counts[static_cast<std::size_t>(run.k)] += static_cast<std::uint64_t>(run.end - run.begin);
  return counts;
}

/// Fills the bits of row (j, k): which springs start at each site, and whether it has a particle.
/// Element t belongs to site row.begin + t.
void fill_alive(const Body& body, std::int32_t j, std::int32_t k, const Row& row,
                std::uint16_t* alive) {
  for (const Run& run : body.row(j, k))
    for (std::int32_t i = run.begin; i < run.end; ++i) alive[i - row.begin] = particle_bit;
  for (std::uint32_t n = 0; n < body.neighbours.size(); ++n)
    for (const Range& range : body.springs_of(j, k, body.neighbours[n]))
      for (std::int32_t i = range.begin; i < range.end; ++i)
        alive[i - row.begin] = static_cast<std::uint16_t>(alive[i - row.begin] | 1u << n);
}

/// Throws OutsideError if the block is too large: kernels count its rows, and the places of a row
/// with its margins, in 32 bits.
void check_block(const Body& body, std::int32_t planes) {
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  const std::int64_t rows = (std::int64_t{planes} + 2 * body.reach) * body.grid.sites[1];
  constexpr std::int64_t around =
      4 * scratch_margin;  // more than the margins, rounded to whole vectors
  if (rows > most || body.grid.sites[0] > most - around)
    throw OutsideError(
        "too many sites for a thread: at most 2^31 rows, of at most 2^31 sites with their margins; "
        "take more threads, or a body that is long in z");
}

}  // namespace

GridLayout::GridLayout(const Model& model, int threads) : Layout(model) {
  const Body& body = model.body;
  const std::int32_t planes = body.grid.sites[2];
  check_block(body, 1);
  const std::uint64_t wanted = static_cast<std::uint64_t>(std::clamp(threads, 1, planes));
  // A neighbour's row may begin left or right of any row: reading there must stay inside the array.
  const std::uint64_t padding = whole_vectors(body.grid.sites[0] + 2 * scratch_margin);
  scratch_width_ =
      static_cast<std::int32_t>(whole_vectors(body.grid.sites[0] + 2 * scratch_margin + 1));

  const auto counts = particles_per_plane(body);
  std::uint64_t before = 0;
  std::int32_t first = 0;
  // Blocks have about equal numbers of particles, and at least one plane each.
  for (std::uint64_t block = 0; block < wanted; ++block) {
    const auto rest = static_cast<std::int32_t>(wanted - block - 1);
    std::int32_t next = first;
    const std::uint64_t target = body.particles * (block + 1) / wanted;
    do before += counts[static_cast<std::size_t>(next++)];
    while (next < planes - rest &&
           (rest == 0 || before + counts[static_cast<std::size_t>(next)] / 2 < target));
    planes_.push_back({first, next - first});
    blocks.push_back(make_block(planes_.back(), padding));
    first = next;
  }
  weights_.finish();
}

/// Returns the law of all springs of a row, see Row::law.
std::int32_t GridLayout::law_of_row(std::int32_t material, std::int32_t j, std::int32_t k) const {
  if (model_.springs.laws.size() == 1 && model_.springs.composites.empty()) return 0;
  if (material >= 0)
    return static_cast<std::int32_t>(model_.materials[static_cast<std::size_t>(material)].law);
  Materials materials;
  const auto look = [&](std::span<const Run> runs) {
    for (const Run& run : runs)
      for (Particle p = run.first; p < run.first + static_cast<Particle>(run.end - run.begin); ++p)
        if (model_.kinds.mixtures.empty())
          materials.set(model_.kinds.material(p));
        else
          for (const std::uint8_t of_cell :
               model_.kinds.mixtures.around(model_.kinds.mixtures.of(p)).materials)
            if (of_cell != Mixtures::no_cell) materials.set(of_cell);
  };
  look(model_.body.row(j, k));
  for (const Neighbour& to : model_.body.neighbours)
    if (model_.kinds.mixtures.empty()) look(model_.body.row(j + to.dy, k + to.dz));
  return law_between(materials);
}

BlockLayout GridLayout::make_block(Planes planes, std::uint64_t padding) {
  const Body& body = model_.body;
  check_block(body, planes.count);
  BlockLayout block;
  block.first_own = static_cast<std::uint32_t>(body.reach * body.grid.sites[1]);
  block.last_own = block.first_own + static_cast<std::uint32_t>(planes.count * body.grid.sites[1]);
  std::uint64_t place = padding;
  for (std::int32_t k = planes.first - body.reach; k < planes.first + planes.count + body.reach;
       ++k)
    for (std::int32_t j = 0; j < body.grid.sites[1]; ++j) {
      Row row;
      row.start = place;
      const auto runs = body.row(j, k);
      if (!runs.empty()) {
        row.begin = runs.front().begin;
        row.end = runs.back().end;
        for (std::uint32_t n = 0; n < body.neighbours.size(); ++n)
          if (!body.springs_of(j, k, body.neighbours[n]).empty()) row.neighbours |= 1u << n;
        row.material = material_of_row(model_, j, k);
        row.law = law_of_row(row.material, j, k);
        if (!body.cells.empty()) row.weights = block.weight_sets.size();
        weights_.add_row(body, j, k, row, whole_vectors(row.end - row.begin) / lanes,
                         block.weight_sets);
        place += whole_vectors(row.end - row.begin);
      }
      block.rows.push_back(row);
    }
  block.sites = place + padding;
  return block;
}

std::uint64_t GridLayout::whole_vectors(std::int32_t sites) const {
  const std::uint64_t vector = 64 / bytes_of(model_.springs.choice.precision);
  return (static_cast<std::uint64_t>(sites) + vector - 1) / vector * vector;
}

std::size_t GridLayout::block_of_plane(std::int32_t k) const {
  std::size_t block = 0;
  while (k >= planes_[block].first + planes_[block].count) ++block;
  return block;
}

GridLayout::PlaneRange GridLayout::plane(std::size_t block, std::int32_t k) const {
  const std::vector<Row>& rows = blocks[block].rows;
  const std::uint32_t first = row_of(block, {0, 0, k});
  const Row& last = rows[first + static_cast<std::uint32_t>(model_.body.grid.sites[1]) - 1];
  return {rows[first].start, last.start + whole_vectors(last.end - last.begin)};
}

std::uint32_t GridLayout::row_of(std::size_t block, Site site) const {
  return static_cast<std::uint32_t>(
      (site.k - planes_[block].first + model_.body.reach) * model_.body.grid.sites[1] + site.j);
}

Site GridLayout::first_site_of_row(std::size_t block, std::uint32_t row) const {
  const auto rows = static_cast<std::uint32_t>(model_.body.grid.sites[1]);
  return {blocks[block].rows[row].begin, static_cast<std::int32_t>(row % rows),
          planes_[block].first - model_.body.reach + static_cast<std::int32_t>(row / rows)};
}

Place GridLayout::place(Particle particle) const {
  const Site site = model_.body.site(particle);
  Place found;
  found.block = block_of_plane(site.k);
  found.row = row_of(found.block, site);
  found.site = site.i;
  const Row& row = blocks[found.block].rows[found.row];
  found.index = row.start + static_cast<std::uint64_t>(site.i - row.begin);
  return found;
}

void GridLayout::for_stretches(const std::function<void(const Stretch&)>& visit) const {
  for (const Run& run : model_.body.runs) {
    const std::size_t block = block_of_plane(run.k);
    const Row& row = blocks[block].rows[row_of(block, {run.begin, run.j, run.k})];
    visit({block, row.start + static_cast<std::uint64_t>(run.begin - row.begin), run.first,
           static_cast<std::uint64_t>(run.end - run.begin)});
  }
}

std::uint64_t GridLayout::alive_bits(const Block& block, std::uint64_t index) const {
  return block.alive[index];
}

void GridLayout::fill(Block& block) const {
  const Body& body = model_.body;
  block.alive = AlignedArray<std::uint16_t>(block.layout->sites);
  if (!model_.volumetric.empty() && !model_.volumetric.uniform())
    block.cell_moduli = AlignedArray<double>(block.layout->sites);
  block.memory =
      AlignedArray<double>(block.layout->sites * body.neighbours.size() * kept_numbers());
  if (!model_.kinds.material_of.empty())
    block.material = AlignedArray<std::uint8_t>(block.layout->sites);
  if (!model_.kinds.mixtures.empty())
    block.mixture = AlignedArray<std::uint32_t>(block.layout->sites);
  for (std::uint32_t r = 0; r < block.rows.size(); ++r) {
    const Row& row = block.rows[r];
    if (row.begin == row.end) continue;
    Site site = first_site_of_row(block.number, r);
    fill_alive(body, site.j, site.k, row, block.alive.get() + row.start);
    fill_cells(block, row, site);
    if (starts_memory()) start_row(block, r, site);
    if (model_.materials.size() == 1) continue;
    for (; site.i < row.end; ++site.i) {
      const Particle particle = body.at(site);
      const std::uint64_t place = row.start + static_cast<std::uint64_t>(site.i - row.begin);
      if (particle == Body::no_particle) continue;
      if (model_.kinds.mixtures.empty())
        block.material[place] = model_.kinds.material_of[particle];
      else
        block.mixture[place] = model_.kinds.mixtures.of(particle);
    }
  }
}

/// Marks the cells of a row that have a volumetric energy. `site`: the row's first.
void GridLayout::fill_cells(const Block& block, const Row& row, Site site) const {
  if (model_.volumetric.empty()) return;
  for (const Range& range : model_.volumetric.row(site.j, site.k))
    for (Site cell{range.begin, site.j, site.k}; cell.i < range.end; ++cell.i) {
      const double modulus = model_.volumetric.modulus(cell);
      if (modulus == 0) continue;
      const std::uint64_t place = row.start + static_cast<std::uint64_t>(cell.i - row.begin);
      block.alive[place] = static_cast<std::uint16_t>(block.alive[place] | cell_bit);
      if (block.cell_moduli.size() > 0) block.cell_moduli[place] = modulus;
    }
}

/// Initializes the law's memory for the springs of a row, also of a ghost row.
void GridLayout::start_row(const Block& block, std::uint32_t r, Site site) const {
  const Body& body = model_.body;
  for (std::uint32_t n = 0; n < body.neighbours.size(); ++n) {
    const Neighbour& to = body.neighbours[n];
    for (const Range& range : body.springs_of(site.j, site.k, to))
      for (std::int32_t i = range.begin; i < range.end; ++i)
        start_memory(block, r, n, i, body.at({i, site.j, site.k}),
                     body.at({i + to.dx, site.j + to.dy, site.k + to.dz}), n);
  }
}

std::vector<std::int32_t> GridLayout::ghost_planes(std::size_t block) const {
  const std::int32_t first = planes_[block].first, end = first + planes_[block].count;
  std::vector<std::int32_t> planes;
  for (std::int32_t distance = 1; distance <= model_.body.reach; ++distance)
    for (const std::int32_t k : {first - distance, end + distance - 1})
      if (k >= 0 && k < model_.body.grid.sites[2]) planes.push_back(k);
  return planes;
}

/// Fills the ghost planes from the blocks that own them.
void GridLayout::exchange(const std::vector<Block>& all, Block& block) const {
  for (const std::int32_t k : ghost_planes(block.number)) {
    const Block& owner = all[block_of_plane(k)];
    const std::uint64_t from = plane(owner.number, k).begin;
    const PlaneRange to = plane(block.number, k);
    const std::uint64_t count = to.end - to.begin;
    for (int c = 0; c < model_.degrees_of_freedom; ++c)
      block.displacement[c].copy(owner.displacement[c], from, count, to.begin);
    for (int c = 0; model_.springs.asks_rate && c < model_.degrees_of_freedom; ++c)
      block.velocity[c].copy(owner.velocity[c], from, count, to.begin);
    if ((model_.springs.breakable || model_.springs.softens) && k < planes_[block.number].first)
      std::copy_n(owner.alive.get() + from, count, block.alive.get() + to.begin);
  }
}

std::vector<Layout::Borrowed> GridLayout::borrowed(std::size_t block) const {
  std::vector<Borrowed> ranges;
  for (const std::int32_t k : ghost_planes(block)) {
    const std::size_t owner = block_of_plane(k);
    const PlaneRange rows = plane(owner, k);
    ranges.push_back({owner, rows.begin, rows.end});
  }
  return ranges;
}

void GridLayout::describe(const Block& block, KernelRequest& request) const {
  request.rows_per_plane = model_.body.grid.sites[1];
  request.planes = planes_[block.number].count;
  request.reach = model_.body.reach;
  request.weight_sets = block.layout->weight_sets.data();
  request.weights = weights_.values();
  request.scratch_width = scratch_width_;
  request.mixture = block.mixture.get();
  request.mixture_springs = model_.springs.mixture_springs.data();
  if (!model_.volumetric.empty()) {
    request.cells.spacing = model_.body.grid.spacing;
    request.cells.modulus = model_.volumetric.largest();
    request.cells.moduli = block.cell_moduli.get();
  }
  request.memory = block.memory.get();
  request.memory_numbers = model_.springs.memory;
  request.memory_stride = block.layout->sites;
}

double GridLayout::state_bytes() const {
  const auto number = static_cast<double>(bytes_of(model_.springs.choice.precision));
  const auto memory =
      static_cast<double>(model_.body.neighbours.size() * kept_numbers() * sizeof(double));
  const double a_site = 2.0 * model_.degrees_of_freedom * number + sizeof(std::uint16_t) +
                        (model_.kinds.material_of.empty() ? 0.0 : 1.0) +
                        (model_.kinds.mixtures.empty() ? 0.0 : 4.0) + memory +
                        (model_.volumetric.empty() || model_.volumetric.uniform() ? 0.0 : 8.0);
  double bytes = weights_.bytes();
  for (const BlockLayout& block : blocks)
    bytes += static_cast<double>(block.sites) * a_site +
             static_cast<double>(block.weight_sets.size() * sizeof(std::uint32_t));
  return bytes;
}

std::size_t GridLayout::scratch_numbers() const {
  return scratch_size(model_.body.grid.sites[1], model_.body.reach, scratch_width_,
                      static_cast<std::size_t>(model_.degrees_of_freedom));
}

}  // namespace hyperlattice
