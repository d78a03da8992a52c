#include <run/block.hpp>
#include <run/listed_layout.hpp>

#include <algorithm>
#include <stdexcept>

namespace hyperlattice {

namespace {

constexpr std::uint64_t vectors_for(std::uint64_t particles) { return (particles + lanes - 1) / lanes; }

}  // namespace

ListedLayout::ListedLayout(const Model& model, int threads) : Layout(model) {
  collect_halves();
  const std::uint64_t particles = model.body.particles, rows = (particles + row_length - 1) / row_length;
  const std::uint64_t wanted = std::clamp<std::uint64_t>(static_cast<std::uint64_t>(threads), 1, rows);
  for (std::uint64_t n = 0; n < wanted; ++n) {
    const Particle first = rows * n / wanted * row_length, last = std::min(rows * (n + 1) / wanted * row_length, particles);
    parts_.push_back(make_part(first, last));
    blocks.push_back(make_block(parts_.back()));
  }
  first_half_ = {};
  halves_ = {};
}

/// Every spring from both of its ends; a particle's in the order of the others.
void ListedLayout::collect_halves() {
  const std::vector<ListedSpring>& springs = model_.body.listed.springs;
  first_half_.assign(model_.body.particles + 1, 0);
  for (const ListedSpring& spring : springs) {
    ++first_half_[spring.a + 1];
    ++first_half_[spring.b + 1];
  }
  for (Particle p = 0; p < model_.body.particles; ++p) first_half_[p + 1] += first_half_[p];
  halves_.resize(2 * springs.size());
  std::vector<std::uint64_t> next(first_half_.begin(), first_half_.end() - 1);
  for (std::uint32_t n = 0; n < springs.size(); ++n) halves_[next[springs[n].b]++] = {springs[n].a, n};  // first those to particles before
  for (std::uint32_t n = 0; n < springs.size(); ++n) halves_[next[springs[n].a]++] = {springs[n].b, n};
}

ListedLayout::Part ListedLayout::make_part(Particle first, Particle last) const {
  Part part;
  part.first = first;
  part.last = last;
  part.first_slot.push_back(0);
  for (Particle start = first; start < last; start += lanes) {
    const Particle end = std::min<Particle>(start + lanes, last);
    std::size_t slots = 0;
    for (Particle p = start; p < end; ++p) slots = std::max(slots, halves(p).size());
    const std::size_t at = part.springs.size();
    part.springs.resize(at + slots * lanes, no_spring);
    for (Particle p = start; p < end; ++p)
      for (std::size_t slot = 0; slot < halves(p).size(); ++slot) {
        const Half half = halves(p)[slot];
        part.springs[at + slot * lanes + (p - start)] = half.spring;
        if (half.other < first || half.other >= last) part.ghosts.push_back(half.other);
      }
    part.first_slot.push_back(static_cast<std::uint32_t>(part.springs.size() / lanes));
  }
  std::sort(part.ghosts.begin(), part.ghosts.end());
  part.ghosts.erase(std::unique(part.ghosts.begin(), part.ghosts.end()), part.ghosts.end());
  return part;
}

BlockLayout ListedLayout::make_block(const Part& part) const {
  BlockLayout block;
  const bool weighted = !model_.body.listed.shares.empty();
  for (Particle first = part.first; first < part.last; first += row_length) {
    const Particle last = std::min<Particle>(first + row_length, part.last);
    Row row;
    row.end = static_cast<std::int32_t>(last - first);
    row.start = first - part.first;
    row.material = material_of_row(first, last);
    if (weighted) row.weights = block.weight_sets.size();
    for (std::uint64_t n = 0; weighted && n < vectors_for(last - first); ++n)
      block.weight_sets.push_back(static_cast<std::uint32_t>((row.start / lanes + n) * lanes));
    block.rows.push_back(row);
  }
  block.last_own = static_cast<std::uint32_t>(block.rows.size());
  block.sites = vectors_for(part.last - part.first) * lanes;
  return block;
}

std::int32_t ListedLayout::material_of_row(Particle first, Particle last) const {
  const std::uint8_t material = model_.material(first);
  for (Particle p = first; p < last; ++p)
    if (model_.material(p) != material) return -1;
  return material;
}

/// Whether springs differ in stiffness, so that each needs its own.
bool ListedLayout::has_own_stiffness() const {
  const std::vector<ListedSpring>& springs = model_.body.listed.springs;
  return model_.choice.mixed || std::any_of(springs.begin(), springs.end(), [](const ListedSpring& spring) { return spring.stiffness != 1; });
}

Place ListedLayout::place(Particle particle) const {
  Place found;
  while (particle >= parts_[found.block].last) ++found.block;
  found.index = particle - parts_[found.block].first;
  found.row = static_cast<std::uint32_t>(found.index / row_length);
  found.site = static_cast<std::int32_t>(found.index % row_length);
  return found;
}

void ListedLayout::for_stretches(const std::function<void(const Stretch&)>& visit) const {
  for (std::size_t n = 0; n < parts_.size(); ++n) visit({n, 0, parts_[n].first, parts_[n].last - parts_[n].first});
}

SpringEnds ListedLayout::spring(std::size_t block, std::uint32_t row, std::uint32_t neighbour, std::int32_t site) const {
  const Part& part = parts_[block];
  const std::uint32_t number = part.springs[std::size_t{neighbour} * lanes + static_cast<std::size_t>(site % lanes)];
  const ListedSpring& spring = model_.body.listed.springs[number];
  const Particle here = part.first + row * row_length + static_cast<Particle>(site);
  return {spring.a, spring.b, number, here == spring.a};
}

std::uint64_t ListedLayout::other_end(std::size_t, std::uint32_t, std::uint32_t, std::int32_t) const {
  throw std::logic_error("a listed body holds no velocities of others");  // a model with criteria that ask for them is refused
}

std::uint64_t ListedLayout::alive_bits(const Block& block, std::uint64_t index) const {
  const std::vector<std::uint32_t>& first = parts_[block.number].first_slot;
  std::uint64_t bits = 0;
  for (std::uint32_t slot = first[index / lanes]; slot < first[index / lanes + 1]; ++slot)
    bits = bits << 1 ^ bits >> 63 ^ (block.listed.alive[slot] >> (index % lanes) & 1U);
  return bits;
}

void ListedLayout::fill(Block& block) const {
  const Part& part = parts_[block.number];
  const std::size_t numbers = part.springs.size();
  const std::uint64_t count = part.last - part.first;
  block.alive = AlignedArray<std::uint16_t>(block.layout->sites);
  std::fill_n(block.alive.get(), count, particle_bit);
  if (!model_.material_of.empty()) {
    block.material = AlignedArray<std::uint8_t>(block.layout->sites);
    for (std::uint64_t n = 0; n < count; ++n) block.material[n] = model_.material_of[part.first + n];
  }
  ListedArrays& listed = block.listed;
  if (!model_.body.listed.shares.empty()) {
    listed.shares = AlignedArray<double>(block.layout->sites);
    std::fill_n(listed.shares.get(), block.layout->sites, 1.0);
    for (std::uint64_t n = 0; n < count; ++n) listed.shares[n] = model_.body.listed.shares[part.first + n];
  }
  listed.first = AlignedArray<std::uint32_t>(part.first_slot.size());
  std::copy(part.first_slot.begin(), part.first_slot.end(), listed.first.get());
  listed.neighbour = AlignedArray<std::uint32_t>(numbers);
  listed.rest = AlignedArray<double>(4 * numbers);
  listed.alive = AlignedArray<std::uint8_t>(numbers / lanes);
  if (has_own_stiffness()) listed.stiffness = AlignedArray<double>(2 * numbers);
  if (model_.choice.breakable) listed.alarm = AlignedArray<double>(numbers);
  listed.around = AlignedArray<double>(4 * (block.layout->sites + part.ghosts.size()));
  for (std::size_t vector = 0; vector + 1 < part.first_slot.size(); ++vector)
    for (std::size_t n = std::size_t{part.first_slot[vector]} * lanes; n < std::size_t{part.first_slot[vector + 1]} * lanes; ++n) {
      const std::uint64_t own = vector * lanes + n % lanes;
      listed.neighbour[n] = static_cast<std::uint32_t>(own);  // a lane without a spring looks at itself
      listed.rest[n / lanes * 4 * lanes + 3 * lanes + n % lanes] = 1;
      if (part.springs[n] != no_spring) fill_spring(block, n, part.first + own);
    }
}

/// One end of a spring: entry n of the slots, [slot][lane], is the particle's.
void ListedLayout::fill_spring(Block& block, std::size_t n, Particle particle) const {
  const Part& part = parts_[block.number];
  const ListedSpring& spring = model_.body.listed.springs[part.springs[n]];
  const Joint joint = model_.joint(spring.a, spring.b, part.springs[n]);
  const bool is_first = particle == spring.a;
  const Particle other = is_first ? spring.b : spring.a;
  const std::size_t slot = n / lanes, lane = n % lanes;
  ListedArrays& listed = block.listed;
  if (other >= part.first && other < part.last) {
    listed.neighbour[n] = static_cast<std::uint32_t>(other - part.first);
  } else {
    const auto ghost = std::lower_bound(part.ghosts.begin(), part.ghosts.end(), other) - part.ghosts.begin();
    listed.neighbour[n] = static_cast<std::uint32_t>(block.layout->sites + static_cast<std::uint64_t>(ghost));
  }
  const Vec3 rest = is_first ? joint.rest : -1.0 * joint.rest;
  double* numbers = listed.rest.get() + slot * 4 * lanes + lane;
  numbers[0] = rest.x;
  numbers[lanes] = rest.y;
  numbers[2 * lanes] = rest.z;
  numbers[3 * lanes] = joint.rest_length;
  listed.alive[slot] = static_cast<std::uint8_t>(listed.alive[slot] | 1U << lane);
  if (listed.stiffness.size() > 0) {
    listed.stiffness[slot * 2 * lanes + lane] = joint.stiffness;
    listed.stiffness[slot * 2 * lanes + lanes + lane] = joint.cross_stiffness;
  }
  if (listed.alarm.size() > 0) listed.alarm[n] = model_.alarm(model_.material(spring.a), model_.material(spring.b), model_.facts(joint));
}

void ListedLayout::exchange(const std::vector<Block>& all, Block& block) const {
  const Part& part = parts_[block.number];
  double* to = block.listed.around.get();
  const auto copy = [&](const Block& from, std::uint64_t index) {
    for (int c = 0; c < model_.degrees_of_freedom; ++c) to[c] = from.displacement[c][index];
    to += 4;
  };
  for (std::uint64_t n = 0; n < block.layout->sites; ++n) copy(block, n);
  std::size_t owner = 0;
  for (const Particle ghost : part.ghosts) {
    while (ghost >= parts_[owner].last) ++owner;
    copy(all[owner], ghost - parts_[owner].first);
  }
}

void ListedLayout::describe(const Block& block, KernelRequest& request) const {
  request.rows_per_plane = static_cast<std::int32_t>(block.rows.size());
  request.planes = 1;
  request.reach = 0;
  request.weight_sets = block.layout->weight_sets.data();
  request.weights = block.listed.shares.get();
  request.scratch_width = row_length;
  request.listed = {block.listed.first.get(), block.listed.neighbour.get(), block.listed.rest.get(),  block.listed.stiffness.get(),
                    block.listed.alarm.get(), block.listed.alive.get(),     block.listed.around.get()};
}

double ListedLayout::state_bytes() const {
  constexpr double number = sizeof(double);
  const double state = (2.0 * model_.degrees_of_freedom + 4 + (model_.body.listed.shares.empty() ? 0 : 1)) * number + double{sizeof(std::uint16_t)} +
                       (model_.material_of.empty() ? 0 : 1);
  const double slot_lane =
      double{sizeof(std::uint32_t)} + 1.0 / lanes + (4 + (has_own_stiffness() ? 2 : 0) + (model_.choice.breakable ? 1 : 0)) * number;
  double bytes = 0;
  for (std::size_t n = 0; n < blocks.size(); ++n)
    bytes += static_cast<double>(blocks[n].sites) * state + static_cast<double>(parts_[n].ghosts.size()) * 4 * number +
             static_cast<double>(parts_[n].springs.size()) * slot_lane +
             static_cast<double>((parts_[n].first_slot.size() + blocks[n].weight_sets.size()) * sizeof(std::uint32_t));
  return bytes;
}

std::size_t ListedLayout::scratch_numbers() const { return row_length * static_cast<std::size_t>(model_.degrees_of_freedom); }

}  // namespace hyperlattice
