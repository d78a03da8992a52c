// Fills the arrays of a block of a listed body.
#include <state/block.hpp>
#include <state/listed_layout.hpp>

#include <algorithm>

namespace hyperlattice {

void ListedLayout::fill(Block& block) const {
  const Part& part = parts_[block.number];
  const std::uint64_t count = part.last - part.first;
  block.alive = AlignedArray<std::uint16_t>(block.layout->sites);
  std::fill_n(block.alive.get(), count, particle_bit);
  if (!model_.kinds.material_of.empty()) {
    block.material = AlignedArray<std::uint8_t>(block.layout->sites);
    for (std::uint64_t n = 0; n < count; ++n)
      block.material[n] = model_.kinds.material_of[part.first + n];
  }
  if (!model_.body.listed.shares.empty()) {
    block.listed.shares = AlignedArray<double>(block.layout->sites);
    std::fill_n(block.listed.shares.get(), block.layout->sites, 1.0);
    for (std::uint64_t n = 0; n < count; ++n)
      block.listed.shares[n] = model_.body.listed.shares[part.first + n];
  }
  fill_records(block);
  fill_springs(block);
}

void ListedLayout::fill_records(Block& block) const {
  const Part& part = parts_[block.number];
  block.listed.records = Numbers(model_.springs.choice.precision,
                                 record_numbers * (block.layout->sites + part.ghosts.size()));
  if (model_.springs.asks_rate)
    block.listed.velocity = Numbers(model_.springs.choice.precision,
                                    static_cast<std::size_t>(model_.degrees_of_freedom) *
                                        (block.layout->sites + part.ghosts.size()));
  const std::vector<Vec3>& positions = model_.body.listed.positions;
  // The same for all blocks; positions relative to it keep their precision in floats.
  const Vec3 origin = positions[positions.size() / 2];
  const auto set = [&](Particle particle) {
    const Vec3 x = positions[particle] - origin;
    const std::size_t record = record_numbers * std::size_t{record_of(part, particle)};
    block.listed.records.set(record, x.x);
    block.listed.records.set(record + 1, x.y);
    block.listed.records.set(record + 2, x.z);
    block.listed.records.set(record + record_material, model_.kinds.material(particle));
  };
  for (Particle particle = part.first; particle < part.last; ++particle) set(particle);
  for (const Particle ghost : part.ghosts) set(ghost);
}

/// Fills the slots of each particle with its springs, in the order of the list.
void ListedLayout::fill_springs(Block& block) const {
  const Part& part = parts_[block.number];
  ListedArrays& listed = block.listed;
  listed.first = AlignedArray<std::uint32_t>(part.first_slot.size());
  std::copy(part.first_slot.begin(), part.first_slot.end(), listed.first.get());
  listed.neighbour = AlignedArray<std::uint32_t>(neighbours(part));
  const Precision precision = model_.springs.choice.precision;
  if (has_own_stiffness()) listed.stiffness = Numbers(precision, 2 * slot_lanes(part));
  if (model_.springs.breakable) listed.alarm = Numbers(precision, slot_lanes(part));
  block.memory = AlignedArray<double>(slot_lanes(part) * kept_numbers());
  for (std::size_t pack = 0; pack + 1 < part.first_slot.size(); ++pack)
    for (std::size_t n = part.first_slot[pack] * width_; n < part.first_slot[pack + 1] * width_;
         ++n)
      // A lane without a spring has its own particle as neighbour.
      listed.neighbour[n] = static_cast<std::uint32_t>(pack * width_ + n % width_);

  std::vector<std::uint32_t> taken(block.layout->sites, 0);  // slots in use per particle
  const auto add = [&](Particle here, Particle there, const SpringProperties& properties,
                       double alarm, std::uint32_t index) {
    if (!part.holds(here)) return;
    const std::uint64_t own = here - part.first, lane = own % width_;
    const std::size_t slot = part.first_slot[own / width_] + taken[own]++;
    listed.neighbour[slot * width_ + lane] = record_of(part, there);
    if (starts_memory())
      start_memory(block, 0, static_cast<std::uint32_t>(slot), static_cast<std::int32_t>(lane),
                   here, there, index);
    if (!listed.alarm.empty()) listed.alarm.set(slot * width_ + lane, alarm);
    if (listed.stiffness.empty()) return;
    listed.stiffness.set(slot * 2 * width_ + lane, properties.stiffness);
    listed.stiffness.set((slot * 2 + 1) * width_ + lane, properties.cross_stiffness);
  };
  for (std::uint32_t n = 0; n < model_.body.listed.springs.size(); ++n) {
    const ListedSpring& spring = model_.body.listed.springs[n];
    if (!part.holds(spring.a) && !part.holds(spring.b)) continue;
    const SpringProperties properties = model_.spring_properties(spring.a, spring.b, n);
    const double alarm =
        model_.springs.breakable ? model_.alarm(spring.a, spring.b, n, properties) : infinity;
    const double growth = precision == Precision::floats
                              ? squared_growth<float>(properties.rest_length, alarm)
                              : squared_growth(properties.rest_length, alarm);
    add(spring.a, spring.b, properties, growth, n);
    add(spring.b, spring.a, properties, growth, n);
  }
}

}  // namespace hyperlattice
