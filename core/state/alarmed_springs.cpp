#include <state/alarmed_springs.hpp>

#include <hyperlattice/kernel_request.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

/// Returns the growth of the squared length, m2, below which no spring to a neighbour is above its
/// alarm.
double quiet_growth(const SpringTable& springs, const NeighbourGeometry& to) {
  // The parts of a composite spring, and the cells of several materials, have alarms of their own.
  if (!springs.composites.empty() || !springs.mixture_springs.empty()) return -infinity;
  double most = infinity;
  for (std::size_t a = 0; a < springs.materials; ++a)
    for (std::size_t b = 0; b < springs.materials; ++b) {
      const double alarm = springs
                               .spring(static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b),
                                       to.site.spring_class)
                               .alarm;
      if (alarm <= -to.rest_length) return -infinity;
      if (alarm < infinity) most = std::min(most, squared_growth(to.rest_length, alarm));
    }
  return most;
}

}  // namespace

bool reaches_alarm(const Model& model, const SpringProperties& properties, double alarm,
                   double elongation, const Layout::Memory& memory) {
  if (properties.composite == nullptr || !properties.composite->in_series())
    return elongation > alarm;
  const LawNumbers kept = read_numbers(memory, model.springs.memory);
  const auto parts = properties.composite->parts();
  return std::any_of(parts.begin(), parts.end(), [&](const SpringPart& part) {
    return model.elongation_in(part.material, properties, elongation, kept.data()) >
           model.own_alarm(part.material, properties);
  });
}

bool reaches_alarm(const BlockSet& blocks, const Block& block, const SpringPlace& spring,
                   double elongation) {
  const Model& model = blocks.model();
  const auto& [a, b, neighbour, is_first] = spring.ends;
  const SpringProperties properties = model.spring_properties(a, b, neighbour);
  const Layout::Memory memory =
      model.springs.memory > 0
          ? blocks.layout().memory(block, spring.row, spring.neighbour, spring.site, false)
          : Layout::Memory{};
  return reaches_alarm(model, properties, model.alarm(a, b, neighbour, properties), elongation,
                       memory);
}

std::vector<std::vector<AlarmedPlace>> alarmed_springs(const BlockSet& blocks, double part) {
  const Model& model = blocks.model();
  std::vector<std::vector<AlarmedPlace>> found(blocks.size());
  std::vector<GrowthBounds> quiet;
  for (const NeighbourGeometry& to : model.springs.neighbours)
    quiet.push_back({-infinity, quiet_growth(model.springs, to)});
  blocks.team().for_each(blocks.size(), [&](std::size_t b) {
    const Block& block = blocks[b];
    blocks.layout().for_springs_beyond(block, quiet, [&](const SpringPlace& spring) {
      const SpringProperties properties =
          model.spring_properties(spring.ends.a, spring.ends.b, spring.ends.neighbour);
      const double elongation = part * blocks.elongation(spring.ends, properties);
      if (reaches_alarm(blocks, block, spring, elongation))
        found[b].push_back({spring, elongation});
    });
  });
  return found;
}

}  // namespace hyperlattice
