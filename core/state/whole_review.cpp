#include <state/whole_review.hpp>

#include <hyperlattice/kernel_request.hpp>

#include <algorithm>
#include <utility>

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

/// Returns the springs of each block that are above their alarm.
WholeReview::AlarmedOfBlocks WholeReview::alarmed() {
  const Model& model = blocks_.model();
  AlarmedOfBlocks found(blocks_.size());
  std::vector<GrowthBounds> quiet;
  for (const NeighbourGeometry& to : model.springs.neighbours)
    quiet.push_back({-infinity, quiet_growth(model.springs, to)});
  blocks_.team().for_each(blocks_.size(), [&](std::size_t b) { blocks_.exchange(blocks_[b]); });
  blocks_.team().for_each(blocks_.size(), [&](std::size_t b) {
    const Block& block = blocks_[b];
    blocks_.layout().for_springs_beyond(block, quiet, [&](const SpringPlace& spring) {
      const SpringProperties properties =
          model.spring_properties(spring.ends.a, spring.ends.b, spring.ends.neighbour);
      const double elongation = blocks_.elongation(spring.ends, properties);
      if (reaches_alarm(block, spring, elongation)) found[b].push_back({spring, elongation});
    });
  });
  return found;
}

bool WholeReview::reaches_alarm(const Block& block, const SpringPlace& spring,
                                double elongation) const {
  const Model& model = blocks_.model();
  const auto& [a, b, neighbour, is_first] = spring.ends;
  const SpringProperties properties = model.spring_properties(a, b, neighbour);
  const Layout::Memory memory =
      model.springs.memory > 0
          ? blocks_.layout().memory(block, spring.row, spring.neighbour, spring.site, false)
          : Layout::Memory{};
  return review_.reaches_alarm(properties, model.alarm(a, b, neighbour, properties), elongation,
                               memory);
}

/// Asks the criteria about a spring with `part` of its elongation.
bool WholeReview::breaks(Block& block, const Alarmed& alarmed, double part) const {
  const SpringPlace& spring = alarmed.spring;
  const double elongation = part * alarmed.elongation;
  return reaches_alarm(block, spring, elongation) &&
         *review_.review(block,
                         {spring.row, spring.neighbour, {&spring.site, 1}, {&elongation, 1}}) != 0;
}

void WholeReview::remove_broken() {
  const AlarmedOfBlocks all = alarmed();
  blocks_.team().for_each(blocks_.size(), [&](std::size_t b) {
    for (const Alarmed& one : all[b])
      if (breaks(blocks_[b], one, 1))
        blocks_.layout().remove(blocks_[b], one.spring.row, one.spring.neighbour, one.spring.site);
  });
}

bool WholeReview::any_breaks(const AlarmedOfBlocks& alarmed, double part) {
  std::vector<std::uint8_t> found(blocks_.size(), 0);
  blocks_.team().for_each(blocks_.size(), [&](std::size_t b) {
    Block& block = blocks_[b];
    if (alarmed[b].empty()) return;
    FailureMemory memory = block.failure_memory;
    std::vector<Particle> noted = block.noted;
    for (const Alarmed& one : alarmed[b])
      if (breaks(block, one, part)) found[b] = 1;
    block.broken.clear();
    block.failure_memory = std::move(memory);
    block.noted = std::move(noted);
  });
  return std::any_of(found.begin(), found.end(), [](std::uint8_t any) { return any != 0; });
}

double WholeReview::overshoot() {
  constexpr int halvings = 20;
  const AlarmedOfBlocks all = alarmed();
  if (!any_breaks(all, 1)) return -1;
  double beyond = 0, step = 1;
  for (int n = 0; n < halvings; ++n) {
    step /= 2;
    if (any_breaks(all, 1 - beyond - step)) beyond += step;
  }
  return beyond;
}

}  // namespace hyperlattice
