#include <state/whole_review.hpp>

#include <algorithm>
#include <utility>

namespace hyperlattice {

WholeReview::AlarmedOfBlocks WholeReview::alarmed() {
  blocks_.team().for_each(blocks_.size(), [&](std::size_t b) { blocks_.exchange(blocks_[b]); });
  return alarmed_springs(blocks_);
}

/// Asks the criteria about a spring with `part` of its elongation.
bool WholeReview::breaks(Block& block, const AlarmedPlace& alarmed, double part) const {
  const SpringPlace& spring = alarmed.spring;
  const double elongation = part * alarmed.elongation;
  return reaches_alarm(blocks_, block, spring, elongation) &&
         *review_.review(block,
                         {spring.row, spring.neighbour, {&spring.site, 1}, {&elongation, 1}}) != 0;
}

void WholeReview::remove_broken() {
  const AlarmedOfBlocks all = alarmed();
  if (!arrays_.empty()) arrays_.ask();
  blocks_.team().for_each(blocks_.size(), [&](std::size_t b) {
    for (const AlarmedPlace& one : all[b])
      if (breaks(blocks_[b], one, 1))
        blocks_.layout().remove(blocks_[b], one.spring.row, one.spring.neighbour, one.spring.site);
  });
}

bool WholeReview::any_breaks(const AlarmedOfBlocks& alarmed, double part) {
  std::vector<std::uint8_t> found(blocks_.size(), 0);
  if (!arrays_.empty()) arrays_.ask(part);
  blocks_.team().for_each(blocks_.size(), [&](std::size_t b) {
    Block& block = blocks_[b];
    if (alarmed[b].empty()) return;
    FailureMemory memory = block.failure_memory;
    std::vector<Particle> noted = block.noted;
    for (const AlarmedPlace& one : alarmed[b])
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
