#include <state/block.hpp>
#include <state/listed_layout.hpp>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace hyperlattice {

ListedLayout::ListedLayout(const Model& model, int threads)
    : Layout(model),
      width_(model.springs.choice.precision == Precision::floats ? lanes_of<float>
                                                                 : lanes_of<double>),
      materials_of_rows_(materials_of_rows()) {
  const std::uint64_t particles = model.body.particles,
                      rows = (particles + row_length - 1) / row_length;
  const std::uint64_t wanted =
      std::clamp<std::uint64_t>(static_cast<std::uint64_t>(threads), 1, rows);
  std::vector<std::uint32_t> springs_of(particles, 0);
  for (const ListedSpring& spring : model.body.listed.springs) {
    ++springs_of[spring.a];
    ++springs_of[spring.b];
  }
  for (std::uint64_t n = 0; n < wanted; ++n) {
    const Particle first = rows * n / wanted * row_length,
                   last = std::min(rows * (n + 1) / wanted * row_length, particles);
    parts_.push_back(make_part(first, last, springs_of));
    blocks.push_back(make_block(parts_.back()));
  }
}

ListedLayout::Part ListedLayout::make_part(Particle first, Particle last,
                                           const std::vector<std::uint32_t>& springs_of) const {
  Part part;
  part.first = first;
  part.last = last;
  part.first_slot.push_back(0);
  const auto count = [&](Particle particle) {
    return springs_of.begin() + static_cast<std::ptrdiff_t>(particle);
  };
  for (Particle start = first; start < last; start += width_)
    part.first_slot.push_back(
        part.first_slot.back() +
        *std::max_element(count(start), count(std::min<Particle>(start + width_, last))));
  for (const ListedSpring& spring : model_.body.listed.springs)
    if (part.holds(spring.a) != part.holds(spring.b))
      part.ghosts.push_back(part.holds(spring.a) ? spring.b : spring.a);
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
    row.law = law_of_row(row.material, first / row_length);
    if (weighted) row.weights = block.weight_sets.size();
    for (std::uint64_t n = 0; weighted && n < padded(last - first); n += lanes)
      block.weight_sets.push_back(static_cast<std::uint32_t>(row.start + n));
    block.rows.push_back(row);
  }
  block.last_own = static_cast<std::uint32_t>(block.rows.size());
  block.sites = padded(part.last - part.first);
  return block;
}

std::int32_t ListedLayout::material_of_row(Particle first, Particle last) const {
  const std::uint8_t material = model_.kinds.material(first);
  for (Particle p = first; p < last; ++p)
    if (model_.kinds.material(p) != material) return -1;
  return material;
}

/// Finds the materials at both ends of the springs of each row of the body.
std::vector<ListedLayout::Materials> ListedLayout::materials_of_rows() const {
  std::vector<Materials> found;
  if (model_.springs.laws.size() == 1 && model_.springs.composites.empty()) return found;
  found.resize((model_.body.particles + row_length - 1) / row_length);
  for (const ListedSpring& spring : model_.body.listed.springs)
    for (const Particle end : {spring.a, spring.b}) {
      found[end / row_length].set(model_.kinds.material(spring.a));
      found[end / row_length].set(model_.kinds.material(spring.b));
    }
  return found;
}

/// Returns the law of all springs of a row of the body, see Row::law.
std::int32_t ListedLayout::law_of_row(std::int32_t material, std::uint64_t row) const {
  const std::int32_t first = model_.nodal_volumes ? first_law_and_more : 0;
  if (materials_of_rows_.empty()) return first;
  Materials materials = materials_of_rows_[row];
  if (materials.none() && material >= 0) materials.set(static_cast<std::size_t>(material));
  const std::int32_t law = law_between(materials);
  return law == 0 ? first : law;
}

/// Returns whether springs differ in stiffness, so that each needs its own.
bool ListedLayout::has_own_stiffness() const {
  const std::vector<ListedSpring>& springs = model_.body.listed.springs;
  return model_.materials.size() > 1 ||
         std::any_of(springs.begin(), springs.end(),
                     [](const ListedSpring& spring) { return spring.stiffness != 1; });
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
  for (std::size_t n = 0; n < parts_.size(); ++n)
    visit({n, 0, parts_[n].first, parts_[n].last - parts_[n].first});
}

/// Returns the record of a particle at the end of a block's spring: its own place, or its ghost's.
std::uint32_t ListedLayout::record_of(const Part& part, Particle particle) const {
  if (part.holds(particle)) return static_cast<std::uint32_t>(particle - part.first);
  const auto ghost =
      std::lower_bound(part.ghosts.begin(), part.ghosts.end(), particle) - part.ghosts.begin();
  return static_cast<std::uint32_t>(padded(part.last - part.first) +
                                    static_cast<std::uint64_t>(ghost));
}

Particle ListedLayout::particle_of(const Part& part, std::uint32_t place) const {
  const std::uint64_t own = padded(part.last - part.first);
  return place < own ? part.first + place : part.ghosts[place - own];
}

SpringEnds ListedLayout::spring(const Block& block, std::uint32_t row, std::uint32_t slot,
                                std::int32_t site) const {
  const Part& part = parts_[block.number];
  const Particle here = part.first + row * row_length + static_cast<Particle>(site);
  const Particle there = particle_of(
      part, block.listed.neighbour[slot * width_ + static_cast<std::uint64_t>(site) % width_]);
  const auto [a, b] = std::minmax(here, there);
  const std::vector<ListedSpring>& springs = model_.body.listed.springs;
  const auto before = [](const ListedSpring& spring, const std::pair<Particle, Particle>& ends) {
    return std::pair<Particle, Particle>(spring.a, spring.b) < ends;
  };
  const auto found = std::lower_bound(springs.begin(), springs.end(), std::pair(a, b), before);
  return {a, b, static_cast<std::uint32_t>(found - springs.begin()), here == a};
}

std::optional<std::uint32_t> ListedLayout::number_in_row(const Block& block, const Place& first,
                                                         std::uint32_t neighbour) const {
  const std::vector<std::uint32_t>& slots = parts_[block.number].first_slot;
  for (std::uint32_t slot = slots[first.index / width_]; slot < slots[first.index / width_ + 1];
       ++slot)
    if (exists(block, first, slot) &&
        spring(block, first.row, slot, first.site).neighbour == neighbour)
      return slot;
  return std::nullopt;
}

bool ListedLayout::exists(const Block& block, const Place& first, std::uint32_t number) const {
  return block.listed.neighbour[number * width_ + first.index % width_] != first.index;
}

void ListedLayout::remove(Block& block, std::uint32_t row, std::uint32_t slot,
                          std::int32_t site) const {
  const std::uint64_t here = block.rows[row].start + static_cast<std::uint64_t>(site);
  block.listed.neighbour[slot * width_ + here % width_] = static_cast<std::uint32_t>(here);
}

Layout::Memory ListedLayout::memory(const Block& block, std::uint32_t, std::uint32_t slot,
                                    std::int32_t site, bool cross) const {
  const std::size_t numbers =
      std::size_t{slot} * kept_numbers() + (cross ? model_.springs.memory : 0);
  return {block.memory.get() + numbers * width_ + static_cast<std::uint64_t>(site) % width_,
          width_};
}

std::uint64_t ListedLayout::other_end(std::size_t, std::uint32_t, std::uint32_t,
                                      std::int32_t) const {
  throw std::logic_error("an array of a listed body holds no particles of other blocks");
}

double ListedLayout::rate(const Block& block, std::uint32_t row, std::uint32_t slot,
                          std::int32_t site) const {
  const std::uint64_t a = block.rows[row].start + static_cast<std::uint64_t>(site),
                      b = block.listed.neighbour[slot * width_ + a % width_];
  const auto components = static_cast<std::uint64_t>(model_.degrees_of_freedom);
  const auto difference = [&](std::size_t number) {
    return block.listed.records[record_numbers * b + number] -
           block.listed.records[record_numbers * a + number];
  };
  double squared_length = 0, product = 0;
  for (std::size_t c = 0; c < components; ++c) {
    const double apart = (c < 3 ? difference(c) : 0) + difference(record_moved + c);
    squared_length += apart * apart;
    product += apart * (block.listed.velocity[components * b + c] -
                        block.listed.velocity[components * a + c]);
  }
  return product / std::sqrt(squared_length);
}

void ListedLayout::for_springs(const Block& block,
                               const std::function<void(const SpringPlace&)>& visit) const {
  const Part& part = parts_[block.number];
  const std::uint64_t count = part.last - part.first;
  for (std::uint64_t index = 0; index < count; ++index)
    for (std::uint32_t slot = part.first_slot[index / width_];
         slot < part.first_slot[index / width_ + 1]; ++slot) {
      if (block.listed.neighbour[slot * width_ + index % width_] == index) continue;
      const auto row = static_cast<std::uint32_t>(index / row_length);
      const auto site = static_cast<std::int32_t>(index % row_length);
      const SpringEnds ends = spring(block, row, slot, site);
      visit({row, slot, site, ends, ends.is_first});
    }
}

void ListedLayout::for_springs_beyond(const Block& block, std::span<const GrowthBounds>,
                                      const std::function<void(const SpringPlace&)>& visit) const {
  for_springs(block, visit);
}

std::uint64_t ListedLayout::alive_bits(const Block& block, std::uint64_t index) const {
  const std::vector<std::uint32_t>& first = parts_[block.number].first_slot;
  std::uint64_t bits = 0;
  for (std::uint32_t slot = first[index / width_]; slot < first[index / width_ + 1]; ++slot)
    bits = bits << 1 ^ bits >> 63 ^
           (block.listed.neighbour[slot * width_ + index % width_] != index ? 1U : 0U);
  return bits;
}

void ListedLayout::exchange(const std::vector<Block>& all, Block& block) const {
  const Part& part = parts_[block.number];
  std::size_t record = record_numbers * block.layout->sites, owner = 0;
  for (const Particle ghost : part.ghosts) {
    while (ghost >= parts_[owner].last) ++owner;
    for (int c = 0; c < model_.degrees_of_freedom; ++c)
      block.listed.records.set(record + record_moved + static_cast<std::size_t>(c),
                               all[owner].displacement[c][ghost - parts_[owner].first]);
    record += record_numbers;
  }
  if (model_.springs.asks_rate) exchange_velocities(all, block);
}

std::vector<Layout::Borrowed> ListedLayout::borrowed(std::size_t block) const {
  std::vector<Borrowed> ranges;
  std::size_t owner = 0;
  for (const Particle ghost : parts_[block].ghosts) {
    while (ghost >= parts_[owner].last) ++owner;
    const std::uint64_t place = ghost - parts_[owner].first;
    if (ranges.empty() || ranges.back().block != owner || ranges.back().end != place)
      ranges.push_back({owner, place, place});
    ++ranges.back().end;
  }
  return ranges;
}

void ListedLayout::exchange_velocities(const std::vector<Block>& all, Block& block) const {
  const Part& part = parts_[block.number];
  const auto components = static_cast<std::size_t>(model_.degrees_of_freedom);
  const auto copy = [&](const Block& from, std::uint64_t place, std::uint64_t record) {
    for (std::size_t c = 0; c < components; ++c)
      block.listed.velocity.set(components * record + c, from.velocity[c][place]);
  };
  for (std::uint64_t place = 0; place < part.last - part.first; ++place) copy(block, place, place);
  std::size_t record = block.layout->sites, owner = 0;
  for (const Particle ghost : part.ghosts) {
    while (ghost >= parts_[owner].last) ++owner;
    copy(all[owner], ghost - parts_[owner].first, record++);
  }
}

void ListedLayout::describe(const Block& block, KernelRequest& request) const {
  request.rows_per_plane = static_cast<std::int32_t>(block.rows.size());
  request.planes = 1;
  request.reach = 0;
  request.weight_sets = block.layout->weight_sets.data();
  request.weights = block.listed.shares.get();
  request.scratch_width = row_length;
  request.listed = {block.listed.first.get(),     block.listed.neighbour.get(),
                    block.listed.stiffness.get(), block.listed.alarm.get(),
                    block.listed.records.get(),   block.memory.get()};
  request.memory_numbers = model_.springs.memory;
}

double ListedLayout::state_bytes() const {
  const double number = model_.springs.choice.precision == Precision::floats ? sizeof(float)
                                                                             : sizeof(double),
               velocities = model_.springs.asks_rate ? model_.degrees_of_freedom : 0,
               record = (static_cast<double>(record_numbers) + velocities) * number;
  const double state = 2.0 * model_.degrees_of_freedom * number + record +
                       (model_.body.listed.shares.empty() ? 0.0 : double{sizeof(double)}) +
                       double{sizeof(std::uint16_t)} + (model_.kinds.material_of.empty() ? 0 : 1);
  const double slot_lane =
      ((has_own_stiffness() ? 2 : 0) + (model_.springs.breakable ? 1 : 0)) * number +
      static_cast<double>(kept_numbers() * sizeof(double));
  double bytes = 0;
  for (std::size_t n = 0; n < blocks.size(); ++n)
    bytes += static_cast<double>(blocks[n].sites) * state +
             static_cast<double>(parts_[n].ghosts.size()) * record +
             static_cast<double>(slot_lanes(parts_[n])) * slot_lane +
             static_cast<double>((neighbours(parts_[n]) + parts_[n].first_slot.size() +
                                  blocks[n].weight_sets.size()) *
                                 sizeof(std::uint32_t));
  return bytes;
}

std::size_t ListedLayout::scratch_numbers() const {
  return row_length * static_cast<std::size_t>(model_.degrees_of_freedom);
}

}  // namespace hyperlattice
