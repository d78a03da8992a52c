#include <model/array_criterion.hpp>
#include <scene/stage_call.hpp>
#include <state/array_criteria.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hyperlattice {

ArrayCriteria::ArrayCriteria(const BlockSet& blocks, const Clock& clock)
    : blocks_(blocks), model_(blocks.model()), clock_(clock) {
  for (std::size_t material = 0; material < model_.materials.size(); ++material)
    for (const Material::Criterion& criterion : model_.materials[material].failures)
      if (const ArrayFailureFunctions* functions = array_functions(criterion))
        criteria_.push_back({&criterion, functions, static_cast<std::uint8_t>(material), {}});
}

void ArrayCriteria::ask(double part) {
  const std::vector<std::vector<AlarmedPlace>> alarmed = alarmed_springs(blocks_, part);
  for (Asked& asked : criteria_) ask(asked, alarmed);
}

bool ArrayCriteria::breaks(std::uint32_t number, Particle a, Particle b) const {
  const auto found = std::find_if(criteria_.begin(), criteria_.end(), [&](const Asked& asked) {
    return asked.criterion->number == number;
  });
  return std::binary_search(found->broken.begin(), found->broken.end(), Ends{a, b});
}

/// Returns the rate of elongation, m/s. Layout::rate() is for the time when the kernels run.
double ArrayCriteria::rate(const SpringEnds& spring, const Vec3& rest) const {
  const auto [block_a, a] = blocks_.at(spring.a);
  const auto [block_b, b] = blocks_.at(spring.b);
  double squared_length = 0, product = 0;
  for (int c = 0; c < model_.degrees_of_freedom; ++c) {
    const double apart =
        (c < 3 ? rest[c] : 0) + (block_b->displacement[c][b] - block_a->displacement[c][a]);
    squared_length += apart * apart;
    product += apart * (block_b->velocity[c][b] - block_a->velocity[c][a]);
  }
  return product / std::sqrt(squared_length);
}

/// Returns the springs of a block that the criterion's material has and that are above the
/// criterion's own alarm.
ArrayCriteria::Arrays ArrayCriteria::springs_of(const Asked& asked, const Block& block,
                                                const std::vector<AlarmedPlace>& alarmed) const {
  Arrays arrays;
  for (const auto& [spring, whole_elongation] : alarmed) {
    if (!spring.counts) continue;
    const SpringMaterials materials =
        model_.materials_of(spring.ends.a, spring.ends.b, spring.ends.neighbour);
    if (std::find(materials.begin(), materials.end(), asked.material) == materials.end()) continue;
    const SpringProperties properties =
        model_.spring_properties(spring.ends.a, spring.ends.b, spring.ends.neighbour);
    const LawNumbers memory =
        blocks_.law_numbers(block, spring.row, spring.neighbour, spring.site, false);
    const SpringFacts facts = model_.facts(properties, asked.material);
    const double elongation =
        model_.elongation_in(asked.material, properties, whole_elongation, memory.data());
    if (!(elongation > asked.criterion->alarm(facts))) continue;
    arrays.elongation.push_back(elongation);
    arrays.rest_length.push_back(facts.rest_length);
    arrays.stiffness.push_back(facts.stiffness);
    arrays.rate.push_back(rate(spring.ends, properties.rest));
    arrays.spring_class.push_back(facts.spring_class);
    arrays.a.push_back(std::min(spring.ends.a, spring.ends.b));
    arrays.b.push_back(std::max(spring.ends.a, spring.ends.b));
  }
  return arrays;
}

void ArrayCriteria::ask(Asked& asked, const std::vector<std::vector<AlarmedPlace>>& alarmed) const {
  std::vector<Arrays> of_blocks(alarmed.size());
  blocks_.team().for_each(alarmed.size(), [&](std::size_t b) {
    of_blocks[b] = springs_of(asked, blocks_[b], alarmed[b]);
  });
  Arrays all;
  for (const Arrays& one : of_blocks) all.append(one);
  // Blocks of a grid are whole rows, in order; those of a list depend on the number of threads.
  if (model_.body.is_listed()) all.sort_by_ends();
  asked.broken.clear();
  if (all.a.empty()) return;
  const SpringArrays springs{clock_.time(), clock_.advanced(), all.elongation,   all.rest_length,
                             all.stiffness, all.rate,          all.spring_class, all.a,
                             all.b};
  std::vector<std::uint8_t> broken(all.a.size(), 0);
  call(*asked.criterion->stage, "breaks", [&](const Complaint& why) {
    return asked.functions->breaks(asked.criterion->component.get(), springs, broken.data(), why);
  });
  for (std::size_t n = 0; n < broken.size(); ++n)
    if (broken[n] != 0) asked.broken.emplace_back(all.a[n], all.b[n]);
  std::sort(asked.broken.begin(), asked.broken.end());
}

void ArrayCriteria::Arrays::append(const Arrays& others) {
  const auto add = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  add(elongation, others.elongation);
  add(rest_length, others.rest_length);
  add(stiffness, others.stiffness);
  add(rate, others.rate);
  add(spring_class, others.spring_class);
  add(a, others.a);
  add(b, others.b);
}

void ArrayCriteria::Arrays::sort_by_ends() {
  std::vector<std::size_t> order(a.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [this](std::size_t one, std::size_t other) {
    return Ends{a[one], b[one]} < Ends{a[other], b[other]};
  });
  const auto arrange = [&](auto& numbers) {
    auto sorted = numbers;
    std::transform(order.begin(), order.end(), sorted.begin(),
                   [&](std::size_t n) { return numbers[n]; });
    numbers = std::move(sorted);
  };
  arrange(elongation);
  arrange(rest_length);
  arrange(stiffness);
  arrange(rate);
  arrange(spring_class);
  arrange(a);
  arrange(b);
}

}  // namespace hyperlattice
