#include <state/whole_review.hpp>

#include <algorithm>
#include <utility>

namespace hyperlattice {

void WholeReview::exchange() {
  blocks_.team().for_each(blocks_.size(), [&](std::size_t b) { blocks_.exchange(blocks_[b]); });
}

/// Asks the criteria about all springs of the block, with `part` of their elongations.
void WholeReview::review(Block& block, double part, bool removes) const {
  const Model& model = blocks_.model();
  const Layout& layout = blocks_.layout();
  layout.for_springs(block, [&](const SpringPlace& spring) {
    if (!model.body.is_listed() && !spring.counts) return;  // ghosts are copied from their owners
    const auto& [a, b, neighbour, is_first] = spring.ends;
    const SpringProperties properties = model.spring_properties(a, b, neighbour);
    const double elongation = part * blocks_.elongation(spring.ends, properties);
    const Layout::Memory memory =
        model.springs.memory > 0
            ? layout.memory(block, spring.row, spring.neighbour, spring.site, false)
            : Layout::Memory{};
    if (!review_.reaches_alarm(properties, model.alarm(a, b, neighbour, properties), elongation,
                               memory))
      return;
    const std::uint8_t* broken =
        review_.review(block, {spring.row, spring.neighbour, {&spring.site, 1}, {&elongation, 1}});
    if (removes && *broken != 0) layout.remove(block, spring.row, spring.neighbour, spring.site);
  });
}

void WholeReview::remove_broken() {
  exchange();
  blocks_.team().for_each(blocks_.size(), [&](std::size_t b) { review(blocks_[b], 1, true); });
}

bool WholeReview::any_breaks(double part) {
  std::vector<std::uint8_t> breaks(blocks_.size(), 0);
  blocks_.team().for_each(blocks_.size(), [&](std::size_t b) {
    Block& block = blocks_[b];
    FailureMemory memory = block.failure_memory;
    std::vector<Particle> noted = block.noted;
    review(block, part, false);
    breaks[b] = block.broken.empty() ? 0 : 1;
    block.broken.clear();
    block.failure_memory = std::move(memory);
    block.noted = std::move(noted);
  });
  return std::any_of(breaks.begin(), breaks.end(), [](std::uint8_t any) { return any != 0; });
}

double WholeReview::overshoot() {
  constexpr int halvings = 20;
  exchange();
  if (!any_breaks(1)) return -1;
  double beyond = 0, step = 1;
  for (int n = 0; n < halvings; ++n) {
    step /= 2;
    if (any_breaks(1 - beyond - step)) beyond += step;
  }
  return beyond;
}

}  // namespace hyperlattice
