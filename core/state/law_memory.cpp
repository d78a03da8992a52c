// The memory of laws outside a step: its advance to a state of rest, and the integrity of springs
// that soften.
#include <model/spring_calls.hpp>
#include <state/parts.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

Layout::Memory Simulation::law_memory(Particle particle, std::uint32_t neighbour,
                                      bool cross) const {
  const Place place = parts_->layout->place(particle);
  return parts_->layout->memory(parts_->blocks[place.block], place.row, neighbour, place.site,
                                cross);
}

void Simulation::for_springs_of_list(const std::function<void(const SpringMemory&)>& visit) const {
  for (const Block& block : parts_->blocks)
    parts_->layout->for_springs(block, [&](const SpringPlace& spring) {
      if (!spring.counts) return;
      SpringMemory found;
      found.index = spring.ends.neighbour;
      for (const bool cross : {false, true})
        if (!cross || parts_->model.choice.membrane != KernelChoice::Membrane::none)
          found.of[cross ? 1 : 0] = parts_->layout->memory(block, spring.row, spring.neighbour,
                                                           spring.site, cross);
      visit(found);
    });
}

/// Returns the elongation, m, of a spring, or of its cross spring. `place(c)`: displacements and
/// heights of the second end less those of the first; `height_sum`: the sum of their heights.
double Simulation::Parts::elongation_of(const SpringProperties& properties, std::size_t cross,
                                        const Vec3& d, double height_difference,
                                        double height_sum) const {
  const double rise = cross == 0 ? height_difference : height_sum,
               delta = model.body.grid.membrane_distance,
               growth = dot(d, 2 * properties.rest + d) +
                        rise * (cross == 0 ? rise : 2 * delta + rise),
               rest_length = properties.rest_length_of(cross);
  return growth / (std::sqrt(rest_length * rest_length + growth) + rest_length);
}

/// Advances the memory of all laws to a state of rest, without a duration. Adds what the laws
/// dissipate to the energy balance.
void Simulation::Parts::advance_laws(const EquilibriumUpdate& to) {
  if (model.memory == 0) return;
  const std::size_t kinds = model.choice.membrane == KernelChoice::Membrane::none ? 1 : 2;
  for (Block& block : blocks)
    layout->for_springs(block, [&](const SpringPlace& spring) {
      const auto [a, b] = std::pair{spring.ends.a, spring.ends.b};
      const SpringProperties properties = model.spring_properties(a, b, spring.ends.neighbour);
      const auto way = [&](std::size_t c) { return to.xyz[3 * b + c] - to.xyz[3 * a + c]; };
      const Vec3 d{way(0), way(1), way(2)};
      const bool has_heights = !to.heights.empty();
      for (std::size_t cross = 0; cross < kinds; ++cross) {
        const double elongation =
            elongation_of(properties, cross, d, has_heights ? to.heights[b] - to.heights[a] : 0,
                          has_heights ? to.heights[b] + to.heights[a] : 0);
        SpringMemory kept =
            memory_of(block, spring.row, spring.neighbour, spring.site, cross);
        const double before =
            ask_spring(model, properties, cross, elongation, kept.data()).integrity;
        const CompositeAnswer answer =
            take_spring(model, properties, cross, elongation, 0, kept.data());
        const Layout::Memory memory = layout->memory(block, spring.row, spring.neighbour,
                                                     spring.site, cross != 0);
        for (std::uint32_t n = 0; n < model.memory; ++n)
          memory.first[n * memory.stride] = kept[n];
        if (!spring.counts) continue;
        halted_energy += properties.share * answer.dissipated;
        softened_energy += properties.share * answer.fractured;
        if (cross == 0 && before > 0 && answer.integrity <= 0)
          receive_gone(block, {spring.row, spring.neighbour, {&spring.site, 1}, {&elongation, 1}});
      }
    });
  collect_breakages(0);
}

void Simulation::add_softening(std::vector<double>& lost) const {
  const Parts& p = *parts_;
  struct Lost {
    Particle a, b;
    double integrity;
  };
  std::vector<std::vector<Lost>> found(p.blocks.size());
  const auto place = [&](Particle particle) {
    const auto [block, index] = p.at(particle);
    const auto number = [&, &of = *block, n = index](std::size_t c) { return of.displacement[c][n]; };
    return std::pair{Vec3{number(0), number(1), number(2)},
                     p.model.degrees_of_freedom == 4 ? number(3) : 0.0};
  };
  p.team.for_each(p.blocks.size(), [&](std::size_t n) {
    const Block& block = p.blocks[n];
    p.layout->for_springs(block, [&](const SpringPlace& spring) {
      if (!spring.counts) return;
      const auto [a, b] = std::pair{spring.ends.a, spring.ends.b};
      const auto [at_a, height_a] = place(a);
      const auto [at_b, height_b] = place(b);
      const SpringProperties properties = p.model.spring_properties(a, b, spring.ends.neighbour);
      const double elongation =
          p.elongation_of(properties, 0, at_b - at_a, height_b - height_a, height_b + height_a);
      const Parts::SpringMemory kept =
          p.memory_of(block, spring.row, spring.neighbour, spring.site, 0);
      const double integrity =
          ask_spring(p.model, properties, 0, elongation, kept.data()).integrity;
      if (integrity < 1) found[n].push_back({a, b, integrity});
    });
  });
  for (const std::vector<Lost>& of_block : found)
    for (const Lost& spring : of_block)
      for (const Particle end : {spring.a, spring.b}) lost[end] += 1 - spring.integrity;
}

}  // namespace hyperlattice
