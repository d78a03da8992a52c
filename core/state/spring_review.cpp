#include <state/spring_review.hpp>

#include <hyperlattice/failure.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

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
  const auto& functions = criterion.stage->functions<FailureFunctions>();
  const double least = criterion.alarm(facts);
  std::vector<std::size_t> asked;
  std::vector<Particle> a, b;
  std::vector<double> elongations, rates, memory;
  std::vector<FailureMemory::mapped_type*> kept;
  for (std::size_t n = first; n < first + elongation.size(); ++n) {
    if (block.answers[n] != 0 || !(elongation[n - first] > least)) continue;
    asked.push_back(n);
    elongations.push_back(elongation[n - first]);
    if (functions.asks_rate) rates.push_back(rate_of(block, alarm, n));
    if (functions.asks_ends) {
      const SpringEnds spring =
          blocks_.layout().spring(block, alarm.row, alarm.neighbour, alarm.sites[n]);
      a.push_back(std::min(spring.a, spring.b));
      b.push_back(std::max(spring.a, spring.b));
    }
    if (functions.memory > 0) {
      const FailureKey key{alarm.row, alarm.neighbour, alarm.sites[n], criterion.number};
      kept.push_back(&block.failure_memory.try_emplace(key, criterion.start).first->second);
      memory.insert(memory.end(), kept.back()->begin(), kept.back()->begin() + functions.memory);
    }
  }
  if (asked.empty()) return;
  std::vector<std::uint8_t> answers(asked.size(), 0);
  const SpringBatch batch{clock_.time(), facts,         elongations,      a, b,
                          rates,         memory.data(), clock_.advanced()};
  call(*criterion.stage, "breaks", [&](const Complaint& why) {
    return functions.review(criterion.component.get(), batch, answers.data(), why);
  });
  for (std::size_t n = 0; n < asked.size(); ++n) block.answers[asked[n]] = answers[n];
  for (std::size_t n = 0; n < kept.size(); ++n)
    std::copy_n(&memory[n * functions.memory], functions.memory, kept[n]->begin());
}

/// Returns the rate of growth of a spring, m/s, from the velocities half a step before. The step
/// has not moved its ends yet.
double SpringReview::rate_of(const Block& block, const AlarmRow& alarm, std::size_t n) const {
  const Row& row = block.rows[alarm.row];
  const std::uint64_t a = row.start + static_cast<std::uint64_t>(alarm.sites[n] - row.begin);
  const std::uint64_t b =
      blocks_.layout().other_end(block.number, alarm.row, alarm.neighbour, alarm.sites[n]);
  const Vec3 rest = model_.springs.neighbours[alarm.neighbour].rest;
  double squared_length = 0, product = 0;
  for (int c = 0; c < model_.degrees_of_freedom; ++c) {
    const double apart =
        (c < 3 ? rest[c] : 0) + (block.displacement[c][b] - block.displacement[c][a]);
    squared_length += apart * apart;
    product += apart * (block.velocity[c][b] - block.velocity[c][a]);
  }
  return product / std::sqrt(squared_length);
}

}  // namespace hyperlattice
