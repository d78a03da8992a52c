// Copies of fields of the whole body, out of the blocks and into them.
#include <state/state.hpp>

#include <algorithm>

namespace hyperlattice {

Team& Simulation::team() const { return state_->blocks.team(); }

void Simulation::copy(const Quantity& quantity, std::vector<double>& values) const {
  const std::uint64_t all = state_->blocks.model().body.particles;
  values.resize(all * static_cast<std::size_t>(quantity.components));
  gather();
  const auto parts = static_cast<std::uint64_t>(state_->blocks.team().count());
  state_->blocks.team().for_each(parts, [&](std::uint64_t part) {
    const Particle first = all * part / parts;
    copy(quantity, first, all * (part + 1) / parts - first,
         values.data() + first * static_cast<std::size_t>(quantity.components));
  });
}

void Simulation::copy(const Quantity& quantity, Particle first, std::uint64_t count,
                      double* values) const {
  const auto components = static_cast<std::size_t>(quantity.components);
  state_->blocks.for_runs(
      [&](const Block& block, std::uint64_t place, Particle start, std::uint64_t length) {
        const Particle from = std::max(start, first), to = std::min(start + length, first + count);
        if (from >= to) return;
        for (std::size_t c = 0; c < components; ++c) {
          const Numbers& numbers =
              (quantity.velocity ? block.velocity
                                 : block.displacement)[quantity.first + static_cast<int>(c)];
          for (Particle n = from; n < to; ++n)
            values[(n - first) * components + c] = numbers[place + (n - start)];
        }
      });
}

void Simulation::set(const Quantity& quantity, const std::vector<double>& values) {
  gather();
  const auto components = static_cast<std::size_t>(quantity.components);
  state_->blocks.for_runs(
      [&](const Block& block, std::uint64_t place, Particle first, std::uint64_t count) {
        for (std::size_t c = 0; c < components; ++c) {
          const Numbers& to =
              (quantity.velocity ? block.velocity
                                 : block.displacement)[quantity.first + static_cast<int>(c)];
          for (std::uint64_t n = 0; n < count; ++n)
            to.set(place + n, values[(first + n) * components + c]);
        }
      });
}

void Simulation::displacements(std::vector<double>& xyz) const { copy({false, 0, 3}, xyz); }
bool Simulation::displacements_in_first(std::vector<double>& xyz, Particle first,
                                        std::uint64_t count) const {
  constexpr std::size_t components = 3;
  xyz.resize(components * count);
  copy({false, 0, components}, first, count, xyz.data());
  state_->blocks.collect(first, count, components, xyz);
  return state_->blocks.ranks().is_first();
}

void Simulation::copy_to_first(Motion what, std::vector<double>& values) const {
  values.clear();
  const Quantity quantity =
      what == Motion::height ? Quantity{false, 3, 1} : Quantity{what == Motion::velocity, 0, 3};
  BlockSet& blocks = state_->blocks;
  if (blocks.model().degrees_of_freedom < quantity.first + quantity.components) return;
  if (blocks.is_whole()) {
    if (blocks.ranks().is_first()) copy(quantity, values);
    return;
  }
  // Few pieces, because each looks for its particles in all rows.
  constexpr std::uint64_t pieces = 64, least = 1 << 16;
  const std::uint64_t all = blocks.model().body.particles, piece = std::max(least, all / pieces);
  const auto components = static_cast<std::size_t>(quantity.components);
  const bool keeps = blocks.ranks().is_first();
  values.resize((keeps ? all : std::min(all, piece)) * components);
  for (Particle first = 0; first < all; first += piece) {
    const std::uint64_t count = std::min(piece, all - first);
    const std::span part =
        std::span(values).subspan((keeps ? first : 0) * components, count * components);
    copy(quantity, first, count, part.data());
    blocks.collect(first, count, components, part);
  }
  if (!keeps) values = {};
}

void Simulation::velocities(std::vector<double>& xyz) const { copy({true, 0, 3}, xyz); }
void Simulation::heights(std::vector<double>& values) const {
  values.clear();
  if (state_->blocks.model().degrees_of_freedom == 4) copy({false, 3, 1}, values);
}

Simulation::WholeMotion Simulation::whole_motion(bool velocity) const {
  const BlockSet& blocks = state_->blocks;
  const Block* only = nullptr;
  std::uint64_t begin = 0, end = 0;
  bool is_whole = true;
  blocks.for_runs([&](const Block& block, std::uint64_t place, Particle, std::uint64_t count) {
    if (only == nullptr) {
      only = &block;
      begin = place;
    } else if (&block != only || place != end) {
      is_whole = false;
    }
    end = place + count;
  });
  if (only == nullptr || !is_whole) return {};
  const Numbers& x = (velocity ? only->velocity : only->displacement)[0];
  return {static_cast<const std::byte*>(x.get()) +
              begin * bytes_of(blocks.model().springs.choice.precision),
          only->component_stride};
}

void Simulation::height_rates(std::vector<double>& values) const {
  values.clear();
  if (state_->blocks.model().degrees_of_freedom == 4) copy({true, 3, 1}, values);
}

void Simulation::alive(std::vector<std::uint16_t>& bits) const {
  bits.resize(state_->blocks.model().body.particles);
  whole().blocks.for_runs(
      [&](const Block& block, std::uint64_t place, Particle first, std::uint64_t count) {
        std::copy_n(block.alive.get() + place, count,
                    bits.begin() + static_cast<std::ptrdiff_t>(first));
      });
}

Layout::Memory Simulation::law_memory(Particle particle, std::uint32_t neighbour,
                                      bool cross) const {
  const BlockSet& blocks = whole().blocks;
  const Place place = blocks.layout().place(particle);
  return blocks.layout().memory(blocks[place.block], place.row, neighbour, place.site, cross);
}

void Simulation::for_springs_of_list(const std::function<void(const SpringMemory&)>& visit) const {
  const BlockSet& blocks = whole().blocks;
  const bool has_cross = blocks.model().springs.choice.membrane != KernelChoice::Membrane::none;
  for (const Block& block : blocks)
    blocks.layout().for_springs(block, [&](const SpringPlace& spring) {
      if (!spring.counts) return;
      SpringMemory found;
      found.index = spring.ends.neighbour;
      for (const bool cross : {false, true})
        if (!cross || has_cross)
          found.of[cross ? 1 : 0] =
              blocks.layout().memory(block, spring.row, spring.neighbour, spring.site, cross);
      visit(found);
    });
}

void Simulation::set_displacements(const std::vector<double>& xyz,
                                   const std::vector<double>& heights) {
  set({false, 0, 3}, xyz);
  if (!heights.empty()) set({false, 3, 1}, heights);
  state_->energy.forget_start();
}

void Simulation::set_velocities(const std::vector<double>& xyz,
                                const std::vector<double>& height_rates) {
  set({true, 0, 3}, xyz);
  if (!height_rates.empty()) set({true, 3, 1}, height_rates);
  state_->energy.forget_start();
}

}  // namespace hyperlattice
