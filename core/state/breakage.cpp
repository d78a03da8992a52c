// Broken springs: the answer of the criterion, the breakage and the energy lost with it.
#include <model/spring_calls.hpp>
#include <state/parts.hpp>

#include <hyperlattice/failure.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {
namespace {

/// The end of a spring: its displacement and height, and their changes in a step.
struct End {
  Vec3 place;
  double height = 0;
  Vec3 moved;
  double raised = 0;
};

/// Returns the end as it was `dt` before now, if its velocity was the present one since then.
End end_of(const Block& block, std::uint64_t n, int components, double dt) {
  const auto moved = [&](int c) { return dt * block.velocity[c][n]; };
  const auto place = [&](int c) { return block.displacement[c][n] - moved(c); };
  End end{{place(0), place(1), place(2)}, 0, {moved(0), moved(1), moved(2)}, 0};
  if (components == 4) {
    end.height = place(3);
    end.raised = moved(3);
  }
  return end;
}

}  // namespace

/// Asks the failure criteria about springs above their alarm. Criteria answer in the order of the
/// scene; a spring that one of them breaks is not shown to those after it.
const std::uint8_t* Simulation::Parts::review(Block& block, const AlarmRow& alarm) const {
  block.answers.assign(alarm.sites.size(), 0);
  const auto ends = [&](std::size_t n) {
    return layout->spring(block, alarm.row, alarm.neighbour, alarm.sites[n]);
  };
  // All of these springs are alike.
  if (model.materials.size() == 1 && !model.body.is_listed()) {
    const SpringEnds first = ends(0);
    const SpringFacts facts =
        model.facts(model.spring_properties(first.a, first.b, first.neighbour), 0);
    for (const Material::Criterion& criterion : model.materials.front().failures)
      ask(block, alarm, criterion, facts, 0, alarm.elongation);
  } else {
    for (std::size_t n = 0; n < alarm.sites.size(); ++n) {
      const SpringEnds spring = ends(n);
      const SpringProperties properties =
          model.spring_properties(spring.a, spring.b, spring.neighbour);
      const SpringMemory memory = memory_of(block, alarm.row, alarm.neighbour, alarm.sites[n], 0);
      // One material whose criterion says so breaks the spring.
      for (const std::uint8_t material : model.materials_of(spring.a, spring.b, spring.neighbour)) {
        const double elongation =
            model.elongation_in(material, properties, alarm.elongation[n], memory.data());
        for (const Material::Criterion& criterion : model.materials[material].failures)
          ask(block, alarm, criterion, model.facts(properties, material), n, {&elongation, 1});
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

Simulation::Parts::SpringMemory Simulation::Parts::memory_of(const Block& block, std::uint32_t row,
                                                             std::uint32_t neighbour,
                                                             std::int32_t site,
                                                             std::size_t cross) const {
  SpringMemory memory{};
  if (model.memory == 0) return memory;
  const Layout::Memory kept = layout->memory(block, row, neighbour, site, cross != 0);
  for (std::uint32_t n = 0; n < model.memory; ++n) memory[n] = kept.first[n * kept.stride];
  return memory;
}

/// Asks a criterion about alike springs from number `first` on, with these elongations of whole
/// springs of the criterion's material. The criterion is shown only springs that are above its own
/// alarm and not broken yet.
void Simulation::Parts::ask(Block& block, const AlarmRow& alarm,
                            const Material::Criterion& criterion, const SpringFacts& facts,
                            std::size_t first, std::span<const double> elongation) const {
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
      const SpringEnds spring = layout->spring(block, alarm.row, alarm.neighbour, alarm.sites[n]);
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
  const SpringBatch batch{time, facts, elongations, a, b, rates, memory.data(), advanced};
  call(*criterion.stage, "breaks", [&](const Complaint& why) {
    return functions.review(criterion.component.get(), batch, answers.data(), why);
  });
  for (std::size_t n = 0; n < asked.size(); ++n) block.answers[asked[n]] = answers[n];
  for (std::size_t n = 0; n < kept.size(); ++n)
    std::copy_n(&memory[n * functions.memory], functions.memory, kept[n]->begin());
}

/// Returns the rate of growth of a spring, m/s, from the velocities half a step before. The step
/// has not moved its ends yet.
double Simulation::Parts::rate_of(const Block& block, const AlarmRow& alarm, std::size_t n) const {
  const Row& row = block.rows[alarm.row];
  const std::uint64_t a = row.start + static_cast<std::uint64_t>(alarm.sites[n] - row.begin);
  const std::uint64_t b =
      layout->other_end(block.number, alarm.row, alarm.neighbour, alarm.sites[n]);
  const Vec3 rest = model.neighbours[alarm.neighbour].rest;
  double squared_length = 0, product = 0;
  for (int c = 0; c < model.degrees_of_freedom; ++c) {
    const double apart =
        (c < 3 ? component(rest, c) : 0) + (block.displacement[c][b] - block.displacement[c][a]);
    squared_length += apart * apart;
    product += apart * (block.velocity[c][b] - block.velocity[c][a]);
  }
  return product / std::sqrt(squared_length);
}

/// Collects the breakages of the step. The log does not depend on the number of threads: blocks are
/// in the order of their particles, and each block's list is in the order of its rows.
void Simulation::Parts::collect_breakages(double dt) {
  for (Block& block : blocks) {
    for (const Block::Broken& broken : block.broken) {
      const SpringEnds& spring = broken.spring;
      if (!spring.is_first) continue;
      Breakage breakage;
      breakage.step = steps;
      breakage.time = time;
      breakage.a = spring.a;
      breakage.b = spring.b;
      breakage.neighbour = spring.neighbour;
      breakage.elongation = broken.elongation;
      breakage.softened = broken.softened;
      breakages.push_back(breakage);
      note_ends(breakage);
      if (!broken.softened) failure_energy += energy_of(breakages.size() - 1, block, broken, dt);
    }
    block.broken.clear();
  }
}

void Simulation::Parts::note_ends(const Breakage& breakage) {
  const auto [block_a, place_a] = at(breakage.a);
  const auto [block_b, place_b] = at(breakage.b);
  ends.push_back({block_a, block_b, place_a, place_b});
}

/// Returns the energy lost with a base spring and its cross springs, J. They pulled during the step
/// that found them broken, so the lost energy includes half a step of that work: this keeps the
/// scheme's balance exact to second order.
double Simulation::Parts::energy_of(std::size_t index, const Block& block,
                                    const Block::Broken& broken, double dt) const {
  const Breakage& breakage = breakages[index];
  const Ends& where = ends[index];
  const SpringProperties properties =
      model.spring_properties(breakage.a, breakage.b, breakage.neighbour);
  const End a = end_of(*where.block_a, where.a, model.degrees_of_freedom, dt),
            b = end_of(*where.block_b, where.b, model.degrees_of_freedom, dt);

  const Vec3 d = b.place - a.place, moved = b.moved - a.moved;
  const double in_space = dot(d, 2 * properties.rest + d),
               rate_in_space = 2 * dot(properties.rest + d, moved);
  // Growth and its rate are those of the squared length, as in kernels/springs.hpp.
  const auto lost = [&](bool cross, double growth, double rate) {
    const double rest_length = cross ? properties.cross_rest_length : properties.rest_length;
    const double length = std::sqrt(rest_length * rest_length + growth);
    const SpringMemory memory =
        memory_of(block, broken.row, broken.neighbour, broken.site, cross ? 1 : 0);
    const CompositeAnswer answer = ask_spring(model, properties, cross ? 1 : 0,
                                              growth / (length + rest_length), memory.data());
    return answer.stored + 0.5 * answer.force * rate / (2 * length);
  };
  const double difference = b.height - a.height, total = b.height + a.height,
               delta = model.body.grid.membrane_distance;
  double energy = lost(false, in_space + difference * difference,
                       rate_in_space + 2 * difference * (b.raised - a.raised));
  if (model.choice.membrane != KernelChoice::Membrane::none)
    energy += lost(true, in_space + total * (2 * delta + total),
                   rate_in_space + 2 * (delta + total) * (b.raised + a.raised));
  return energy * properties.share;
}

double Simulation::Parts::elongation_now(std::size_t index) const {
  const Breakage& breakage = breakages[index];
  const SpringProperties properties =
      model.spring_properties(breakage.a, breakage.b, breakage.neighbour);
  const Ends& where = ends[index];
  const End a = end_of(*where.block_a, where.a, model.degrees_of_freedom, 0),
            b = end_of(*where.block_b, where.b, model.degrees_of_freedom, 0);
  const Vec3 d = b.place - a.place;
  const double growth =
      dot(d, 2 * properties.rest + d) + (b.height - a.height) * (b.height - a.height);
  return growth / (std::sqrt(properties.rest_length * properties.rest_length + growth) +
                   properties.rest_length);
}

}  // namespace hyperlattice
