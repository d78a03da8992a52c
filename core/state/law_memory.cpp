#include <model/spring_calls.hpp>
#include <state/law_memory.hpp>

#include <algorithm>
#include <limits>
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
        const CompositeAnswer before =
            ask_spring(model_, properties, cross, elongation, kept.data());
        /// Returns by how much the work of the mean force of a step in time exceeds the work of the
        /// mean of the forces at its ends, J, which the laws count.
        const auto work_beyond = [&, start = kept](double force_before, double force) {
          LawNumbers own = start;
          if (to.time_step == 0) return 0.0;
          const auto [a_before, height_a] = blocks_.motion(a);
          const auto [b_before, height_b] = blocks_.motion(b);
          const double from = properties.elongation(
              cross,
              properties.growth(cross, b_before - a_before,
                                cross == 0 ? height_b - height_a : height_b + height_a, delta));
          const CompositeAnswer mean =
              take_spring(model_, properties, cross, from + to.forward * (elongation - from),
                          to.forward * to.time_step, own.data());
          return (mean.force - 0.5 * (force_before + force)) * (elongation - from);
        };
        const CompositeAnswer answer =
            take_spring(model_, properties, cross, elongation, to.time_step, kept.data());
        const Layout::Memory memory =
            blocks_.layout().memory(block, spring.row, spring.neighbour, spring.site, cross != 0);
        for (std::uint32_t n = 0; n < model_.springs.memory; ++n)
          memory.first[n * memory.stride] = kept[n];
        if (!spring.counts) continue;
        energy_.count_halted(properties.share *
                             (answer.dissipated + work_beyond(before.force, answer.force)));
        energy_.count_softened(properties.share * answer.fractured);
        if (cross == 0 && before.integrity > 0 && answer.integrity <= 0)
          blocks_.note_gone(block,
                            {spring.row, spring.neighbour, {&spring.site, 1}, {&elongation, 1}});
      }
    });
}

/// Calls visit(spring, properties, elongation, memory) for the base springs of the block, each
/// once.
template <class Visit>
void LawMemory::for_base_springs(const Block& block, const Visit& visit) const {
  blocks_.layout().for_springs(block, [&](const SpringPlace& spring) {
    if (!spring.counts) return;
    const SpringProperties properties =
        model_.spring_properties(spring.ends.a, spring.ends.b, spring.ends.neighbour);
    const LawNumbers kept =
        blocks_.law_numbers(block, spring.row, spring.neighbour, spring.site, false);
    visit(spring.ends, properties, blocks_.elongation(spring.ends, properties), kept);
  });
}

std::vector<WeakenedSpring> LawMemory::weakened() const {
  std::vector<std::vector<WeakenedSpring>> found(blocks_.size());
  blocks_.team().for_each(blocks_.size(), [&](std::size_t n) {
    for_base_springs(blocks_[n], [&](const SpringEnds& ends, const SpringProperties& properties,
                                     double elongation, const LawNumbers& kept) {
      const double integrity = ask_spring(model_, properties, 0, elongation, kept.data()).integrity;
      if (integrity < 1) found[n].push_back({ends.a, ends.b, ends.neighbour, integrity});
    });
  });
  std::vector<WeakenedSpring> all;
  for (const std::vector<WeakenedSpring>& of_block : found)
    all.insert(all.end(), of_block.begin(), of_block.end());
  return all;
}

void LawMemory::field(std::string_view name, std::vector<double>& values) const {
  std::vector<std::size_t> place;  // of the field among those of each law
  place.reserve(model_.springs.laws.size());
  for (const Law& law : model_.springs.laws) {
    const auto& fields = law.stage->component->info.fields;
    place.push_back(static_cast<std::size_t>(
        std::find_if(fields.begin(), fields.end(),
                     [&](const FieldInfo& field) { return field.name == name; }) -
        fields.begin()));
  }
  std::vector<double> weights(model_.body.particles, 0);
  values.assign(model_.body.particles, 0);
  for (const Block& block : blocks_)
    for_base_springs(block, [&](const SpringEnds& ends, const SpringProperties& properties,
                                double elongation, const LawNumbers& kept) {
      for_parts(model_, properties, 0, elongation, kept.data(),
                [&](const Law& law, const OneSpring& spring, double weight) {
                  const std::size_t n =
                      place[static_cast<std::size_t>(&law - model_.springs.laws.data())];
                  if (n >= law.kernels.fields) return;
                  std::array<double, max_law_fields> numbers{};
                  read_fields(law, spring, numbers.data());
                  for (const Particle end : {ends.a, ends.b}) {
                    values[end] += properties.share * weight * numbers[n];
                    weights[end] += properties.share * weight;
                  }
                });
    });
  for (Particle p = 0; p < values.size(); ++p)
    values[p] = weights[p] > 0 ? values[p] / weights[p] : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace hyperlattice
