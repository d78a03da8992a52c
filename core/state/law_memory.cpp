#include <model/spring_calls.hpp>
#include <state/law_memory.hpp>

#include <utility>

namespace hyperlattice {

void LawMemory::advance(const EquilibriumUpdate& to) {
  if (model_.springs.memory == 0) return;
  const double delta = model_.body.grid.membrane_distance;
  const std::size_t kinds = model_.springs.choice.membrane == KernelChoice::Membrane::none ? 1 : 2;
  for (Block& block : blocks_)
    blocks_.layout().for_springs(block, [&](const SpringPlace& spring) {
      const Particle a = spring.ends.a, b = spring.ends.b;
      const SpringProperties properties = model_.spring_properties(a, b, spring.ends.neighbour);
      const auto way = [&](std::size_t c) { return to.xyz[3 * b + c] - to.xyz[3 * a + c]; };
      const Vec3 d{way(0), way(1), way(2)};
      const bool has_heights = !to.heights.empty();
      for (std::size_t cross = 0; cross < kinds; ++cross) {
        const double rise = !has_heights ? 0
                            : cross == 0 ? to.heights[b] - to.heights[a]
                                         : to.heights[b] + to.heights[a];
        const double elongation =
            properties.elongation(cross, properties.growth(cross, d, rise, delta));
        LawNumbers kept =
            blocks_.law_numbers(block, spring.row, spring.neighbour, spring.site, cross != 0);
        const double before =
            ask_spring(model_, properties, cross, elongation, kept.data()).integrity;
        const CompositeAnswer answer =
            take_spring(model_, properties, cross, elongation, 0, kept.data());
        const Layout::Memory memory =
            blocks_.layout().memory(block, spring.row, spring.neighbour, spring.site, cross != 0);
        for (std::uint32_t n = 0; n < model_.springs.memory; ++n)
          memory.first[n * memory.stride] = kept[n];
        if (!spring.counts) continue;
        energy_.count_halted(properties.share * answer.dissipated);
        energy_.count_softened(properties.share * answer.fractured);
        if (cross == 0 && before > 0 && answer.integrity <= 0)
          blocks_.note_gone(block,
                            {spring.row, spring.neighbour, {&spring.site, 1}, {&elongation, 1}});
      }
    });
}

void LawMemory::add_softening(std::vector<double>& lost) const {
  struct Lost {
    Particle a, b;
    double integrity;
  };
  std::vector<std::vector<Lost>> found(blocks_.size());
  const auto place = [&](Particle particle) {
    const auto [block, index] = blocks_.at(particle);
    const auto number = [&, &of = *block, n = index](std::size_t c) {
      return of.displacement[c][n];
    };
    return std::pair{Vec3{number(0), number(1), number(2)},
                     model_.degrees_of_freedom == 4 ? number(3) : 0.0};
  };
  blocks_.team().for_each(blocks_.size(), [&](std::size_t n) {
    const Block& block = blocks_[n];
    blocks_.layout().for_springs(block, [&](const SpringPlace& spring) {
      if (!spring.counts) return;
      const Particle a = spring.ends.a, b = spring.ends.b;
      const auto [at_a, height_a] = place(a);
      const auto [at_b, height_b] = place(b);
      const SpringProperties properties = model_.spring_properties(a, b, spring.ends.neighbour);
      const double elongation =
          properties.elongation(0, properties.growth(0, at_b - at_a, height_b - height_a,
                                                     model_.body.grid.membrane_distance));
      const LawNumbers kept =
          blocks_.law_numbers(block, spring.row, spring.neighbour, spring.site, false);
      const double integrity = ask_spring(model_, properties, 0, elongation, kept.data()).integrity;
      if (integrity < 1) found[n].push_back({a, b, integrity});
    });
  });
  for (const std::vector<Lost>& of_block : found)
    for (const Lost& spring : of_block)
      for (const Particle end : {spring.a, spring.b}) lost[end] += 1 - spring.integrity;
}

}  // namespace hyperlattice
