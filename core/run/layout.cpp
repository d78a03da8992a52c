#include <run/layout.hpp>

#include <algorithm>
#include <utility>

namespace hyperlattice {
namespace {

std::int32_t material_of_row(const Model& model, std::int32_t j, std::int32_t k) {
  if (model.material_of.empty()) return 0;
  std::int32_t found = -2;
  const auto look = [&](std::span<const Run> runs) {
    for (const Run& run : runs)
      for (std::int32_t i = run.begin; i < run.end; ++i) {
        const std::int32_t material = model.material_of[run.first + static_cast<Particle>(i - run.begin)];
        if (found != -2 && found != material) return false;
        found = material;
      }
    return true;
  };
  if (!look(model.body.row(j, k))) return -1;
  for (const Neighbour& to : model.body.neighbours)
    if (!look(model.body.row(j + to.dy, k + to.dz))) return -1;
  return found;
}

std::vector<std::uint64_t> particles_per_plane(const Body& body) {
  std::vector<std::uint64_t> counts(static_cast<std::size_t>(body.grid.sites[2]), 0);
  for (const Run& run : body.runs) counts[static_cast<std::size_t>(run.k)] += static_cast<std::uint64_t>(run.end - run.begin);
  return counts;
}

BlockLayout make_block(const Model& model, std::int32_t first, std::int32_t planes, std::uint64_t padding, WeightSets& weights) {
  const Body& body = model.body;
  BlockLayout block;
  block.first = first;
  block.planes = planes;
  std::uint64_t place = padding;
  for (std::int32_t k = first - body.reach; k < first + planes + body.reach; ++k)
    for (std::int32_t j = 0; j < body.grid.sites[1]; ++j) {
      Row row;
      row.start = place;
      const auto runs = body.row(j, k);
      if (!runs.empty()) {
        row.begin = runs.front().begin;
        row.end = runs.back().end;
        for (std::uint32_t n = 0; n < body.neighbours.size(); ++n)
          if (!body.springs_of(j, k, body.neighbours[n]).empty()) row.neighbours |= 1u << n;
        row.material = material_of_row(model, j, k);
        if (!body.cells.empty()) row.weights = block.weight_sets.size();
        weights.add_row(body, j, k, row, block.weight_sets);
        place += static_cast<std::uint64_t>((row.end - row.begin + lanes - 1) / lanes * lanes);
      }
      block.rows.push_back(row);
    }
  block.sites = place + padding;
  return block;
}

}  // namespace

std::uint64_t BlockLayout::plane_begin(const Body& body, std::int32_t k) const {
  return rows[static_cast<std::size_t>(k - first + body.reach) * static_cast<std::size_t>(body.grid.sites[1])].start;
}

std::uint64_t BlockLayout::plane_end(const Body& body, std::int32_t k) const {
  const Row& last = rows[static_cast<std::size_t>(k - first + body.reach + 1) * static_cast<std::size_t>(body.grid.sites[1]) - 1];
  return last.start + static_cast<std::uint64_t>((last.end - last.begin + lanes - 1) / lanes * lanes);
}

Layout::Layout(const Model& model, int threads) {
  const Body& body = model.body;
  const std::int32_t planes = body.grid.sites[2];
  const std::uint64_t wanted = static_cast<std::uint64_t>(std::clamp(threads, 1, planes));
  // A neighbour's row may begin left or right of any row: reading there must stay inside the array.
  const std::uint64_t padding = static_cast<std::uint64_t>(body.grid.sites[0] + 2 * scratch_margin + lanes - 1) / lanes * lanes;
  scratch_width = (body.grid.sites[0] + 2 * scratch_margin + 2 * lanes - 1) / lanes * lanes;

  const auto counts = particles_per_plane(body);
  std::uint64_t before = 0;
  std::int32_t first = 0;
  for (std::uint64_t block = 0; block < wanted; ++block) {  // equal shares of the particles, at least one plane each
    const auto rest = static_cast<std::int32_t>(wanted - block - 1);
    std::int32_t next = first;
    const std::uint64_t target = body.particles * (block + 1) / wanted;
    do before += counts[static_cast<std::size_t>(next++)];
    while (next < planes - rest && (rest == 0 || before + counts[static_cast<std::size_t>(next)] / 2 < target));
    blocks.push_back(make_block(model, first, next - first, padding, weights));
    first = next;
  }
}

std::size_t Layout::block_of_plane(std::int32_t k) const {
  std::size_t block = 0;
  while (k >= blocks[block].first + blocks[block].planes) ++block;
  return block;
}

double Layout::state_bytes(const Model& model) const {
  const double a_site = 2.0 * model.degrees_of_freedom * sizeof(double) + sizeof(std::uint16_t) + (model.material_of.empty() ? 0.0 : 1.0);
  double bytes = weights.bytes();
  for (const BlockLayout& block : blocks)
    bytes += static_cast<double>(block.sites) * a_site + static_cast<double>(block.weight_sets.size() * sizeof(std::uint32_t));
  return bytes;
}

double Layout::scratch_bytes(const Model& model) const {
  const std::size_t numbers =
      scratch_size(model.body.grid.sites[1], model.body.reach, scratch_width, static_cast<std::size_t>(model.degrees_of_freedom));
  return static_cast<double>(numbers * sizeof(double) * blocks.size());
}

void fill_alive(const Body& body, std::int32_t j, std::int32_t k, const Row& row, std::uint16_t* alive) {
  for (const Run& run : body.row(j, k))
    for (std::int32_t i = run.begin; i < run.end; ++i) alive[i - row.begin] = particle_bit;
  for (std::uint32_t n = 0; n < body.neighbours.size(); ++n)
    for (const Range& range : body.springs_of(j, k, body.neighbours[n]))
      for (std::int32_t i = range.begin; i < range.end; ++i) alive[i - row.begin] = static_cast<std::uint16_t>(alive[i - row.begin] | 1u << n);
}

}  // namespace hyperlattice
