#include <model/array_criterion.hpp>
#include <state/spring_review.hpp>

#include <hyperlattice/failure.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

/// Springs for one call of a criterion, on the stack: most rows that ring do so for one spring or
/// two. Members that the criterion does not ask for are not set.
struct SpringReview::Asked {
  static constexpr std::size_t most = 64;
  std::size_t size = 0;
  std::size_t number[most];  ///< in the row
  double elongation[most], rate[most];
  Particle a[most], b[most];
  FailureMemory::mapped_type* kept[most];
  double memory[most * max_failure_memory];
};

const std::uint8_t* SpringReview::review(Block& block, const AlarmRow& alarm) const {
  block.answers.assign(alarm.sites.size(), 0);
  if (!damage_.empty()) damage_.note(block, alarm);
  const auto ends = [&](std::size_t n) {
    return blocks_.layout().spring(block, alarm.row, alarm.neighbour, alarm.sites[n]);
  };
  // All of these springs are alike.
  if (model_.materials.size() == 1 && !model_.body.is_listed()) {
    const SpringEnds first = ends(0);
    const SpringFacts facts =
        model_.facts(model_.spring_properties(first.a, first.b, first.neighbour), 0);
    for (const Material::Criterion& criterion : model_.materials.front().failures)
      ask(block, alarm, criterion, facts, 0, alarm.elongation);
  } else {
    for (std::size_t n = 0; n < alarm.sites.size(); ++n) {
      const SpringEnds spring = ends(n);
      const SpringProperties properties =
          model_.spring_properties(spring.a, spring.b, spring.neighbour);
      const LawNumbers memory =
          blocks_.law_numbers(block, alarm.row, alarm.neighbour, alarm.sites[n], false);
      // One material whose criterion says so breaks the spring.
      for (const std::uint8_t material :
           model_.materials_of(spring.a, spring.b, spring.neighbour)) {
        const double elongation =
            model_.elongation_in(material, properties, alarm.elongation[n], memory.data());
        for (const Material::Criterion& criterion : model_.materials[material].failures)
          ask(block, alarm, criterion, model_.facts(properties, material), n, {&elongation, 1});
      }
    }
  }
  for (std::size_t n = 0; n < alarm.sites.size(); ++n) {
    if (block.answers[n] == 0) continue;
    block.broken.push_back(
        {ends(n), alarm.elongation[n], alarm.row, alarm.neighbour, alarm.sites[n]});
    const FailureKey first{alarm.row, alarm.neighbour, alarm.sites[n], 0};
    auto kept = block.failure_memory.lower_bound(first);
    while (kept != block.failure_memory.end() && kept->first.row == first.row &&
           kept->first.neighbour == first.neighbour && kept->first.site == first.site)
      kept = block.failure_memory.erase(kept);
  }
  return block.answers.data();
}

/// Asks a criterion about alike springs from number `first` on, with these elongations of whole
/// springs of the criterion's material. The criterion is shown only springs that are above its own
/// alarm and not broken yet.
void SpringReview::ask(Block& block, const AlarmRow& alarm, const Material::Criterion& criterion,
                       const SpringFacts& facts, std::size_t first,
                       std::span<const double> elongation) const {
  const double least = criterion.alarm(facts);
  Asked asked;
  for (std::size_t n = first; n < first + elongation.size(); ++n) {
    if (block.answers[n] != 0 || !(elongation[n - first] > least)) continue;
    asked.elongation[asked.size] = elongation[n - first];
    asked.number[asked.size++] = n;
    if (asked.size == Asked::most) ask(block, alarm, criterion, facts, asked);
  }
  if (asked.size > 0) ask(block, alarm, criterion, facts, asked);
}

/// Asks a criterion about these springs, and forgets them.
void SpringReview::ask(Block& block, const AlarmRow& alarm, const Material::Criterion& criterion,
                       const SpringFacts& facts, Asked& asked) const {
  if (array_functions(criterion) != nullptr) {
    look_up(block, alarm, criterion, asked);
    asked.size = 0;
    return;
  }
  const auto& functions = criterion.stage->functions<FailureFunctions>();
  const std::size_t size = asked.size, rates = functions.asks_rate ? size : 0,
                    ends = functions.asks_ends ? size : 0;
  for (std::size_t n = 0; n < rates; ++n) {
    const std::int32_t site = alarm.sites[asked.number[n]];
    asked.rate[n] = blocks_.layout().rate(block, alarm.row, alarm.neighbour, site);
  }
  for (std::size_t n = 0; n < ends; ++n) {
    const SpringEnds spring =
        blocks_.layout().spring(block, alarm.row, alarm.neighbour, alarm.sites[asked.number[n]]);
    asked.a[n] = std::min(spring.a, spring.b);
    asked.b[n] = std::max(spring.a, spring.b);
  }
  const std::size_t numbers = functions.memory;
  if (numbers > 0)
    for (std::size_t n = 0; n < size; ++n) {
      const FailureKey key{alarm.row, alarm.neighbour, alarm.sites[asked.number[n]],
                           criterion.number};
      asked.kept[n] = &block.failure_memory.try_emplace(key, criterion.start).first->second;
      std::copy_n(asked.kept[n]->begin(), numbers, &asked.memory[n * numbers]);
    }
  const SpringBatch batch{clock_.time(),
                          facts,
                          {asked.elongation, size},
                          {asked.a, ends},
                          {asked.b, ends},
                          {asked.rate, rates},
                          numbers > 0 ? asked.memory : nullptr,
                          clock_.advanced()};
  std::uint8_t answers[Asked::most] = {};
  call(*criterion.stage, "breaks", [&](const Complaint& why) {
    return functions.review(criterion.component.get(), batch, answers, why);
  });
  for (std::size_t n = 0; n < size; ++n) {
    block.answers[asked.number[n]] = answers[n];
    if (numbers > 0) std::copy_n(&asked.memory[n * numbers], numbers, asked.kept[n]->begin());
  }
  asked.size = 0;
}

/// Looks up what a criterion has decided about these springs together with all others.
void SpringReview::look_up(Block& block, const AlarmRow& alarm,
                           const Material::Criterion& criterion, const Asked& asked) const {
  for (std::size_t n = 0; n < asked.size; ++n) {
    const std::size_t number = asked.number[n];
    const SpringEnds spring =
        blocks_.layout().spring(block, alarm.row, alarm.neighbour, alarm.sites[number]);
    const auto [a, b] = std::minmax(spring.a, spring.b);
    block.answers[number] = arrays_.breaks(criterion.number, a, b) ? 1 : 0;
  }
}

}  // namespace hyperlattice
