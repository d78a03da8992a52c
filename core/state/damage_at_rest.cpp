// Damage between states of rest. For given displacements the damage at rest solves
//   R(d) = g(d) q - (1 - d) + b^2 lap d = 0 where it grows, and R <= 0 where it does not,
// with d at least that of the last accepted state. Its drive q is in proportion to the square of
// the stress, so that a factor of the load can be found at which damage grows by a given amount:
// an equation that has a solution also where the load must fall as cracks grow.
#include <state/damage_field.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

namespace {

/// Returns the part of its change that damage takes in a search, given the number of searches
/// before. Searches that go to and fro come to rest in smaller parts.
double part_of_change(int searches) {
  constexpr int patience = 25;
  return std::max(0.1, std::exp2(-searches / patience));
}

}  // namespace

/// Follows the particles beside springs beyond their alarms in the present state.
void DamageField::watch_all() {
  double stretch = infinity, shortening = infinity;
  for (const Cohesive& material : model_.cohesive) {
    if (material.stage == nullptr) continue;
    stretch = std::min(stretch, material.stretch_alarm);
    shortening = std::min(shortening, material.shortening_alarm);
  }
  blocks_.team().for_each(blocks_.size(), [&](std::size_t b) { blocks_.exchange(blocks_[b]); });
  blocks_.team().for_each(blocks_.size(),
                          [&](std::size_t b) { watch(blocks_[b], stretch, shortening); });
  follow_noted();
}

SettledDamage DamageField::settle(const DamageBounds& bounds) {
  watch_all();
  // The records get the damage of the search for its time, so that stresses are those of this
  // damage.
  const auto of_records = [this] {
    std::vector<double> all(records_.numbers(), 0);
    for (const std::uint32_t number : records_.order()) all[number] = records_.damage(number);
    return all;
  };
  std::vector<double> accepted = of_records();
  if (settled_.empty()) settled_ = accepted;
  settled_.resize(records_.numbers(), 0);
  for (const std::uint32_t number : records_.order()) records_.set_damage(number, settled_[number]);
  compute_cells(Part::stress);
  records_.for_each(records_.order(),
                    [this](std::uint32_t record) { compute(record, Part::stress); });

  SettledDamage found;
  std::vector<double> damage = settled_;
  for (std::size_t followed = 0; followed != records_.order().size();) {
    followed = records_.order().size();
    std::vector<std::uint32_t> driven;
    driven.reserve(followed);
    for (const std::uint32_t number : records_.order())
      if (records_[number].material != nullptr && accepted[number] < 1) driven.push_back(number);
    std::vector<double> ratios;
    find_ratios(driven, ratios);
    DamageEquations equations(damage);
    for (std::size_t n = 0; n < driven.size(); ++n) {
      const DamageRecord& record = records_[driven[n]];
      const double in_spacings = record.material->length / model_.body.grid.spacing;
      equations.add({driven[n], accepted[driven[n]], record.shape, ratios[n] * ratios[n]});
      for (const DamageSpring& spring : record.springs())
        if (spring.spread > 0)
          equations.add_other(records_.of(spring.to), in_spacings * in_spacings * spring.spread);
    }
    found.factor = equations.empty() ? bounds.most_factor : equations.solve(bounds);
    // The damaged zone must have records all around it.
    std::vector<Particle> around;
    for (const std::uint32_t number : driven)
      if (damage[number] > 0)
        for (const DamageSpring& spring : records_[number].springs()) around.push_back(spring.to);
    const std::vector<std::uint32_t> added = records_.add(std::move(around));
    accepted.resize(records_.numbers(), 0);
    settled_.resize(records_.numbers(), 0);
    damage.resize(records_.numbers(), 0);
    for (const std::uint32_t number : added) {
      accepted[number] = settled_[number] = damage[number] = 0;
      for (const std::uint32_t cell : records_[number].cells.numbers)
        if (cell != DamageCells::none) compute(records_.cells()[cell], Part::stress);
      compute(number, Part::stress);
    }
  }
  const double part = part_of_change(searches_++);
  for (const std::uint32_t number : records_.order()) {
    const double change = damage[number] - settled_[number];
    found.change = std::max(found.change, std::abs(change));
    damage[number] = settled_[number] + part * change;
    if (damage[number] >= 1 - 1e-4) damage[number] = 1;
    records_.set_damage(number, damage[number]);
    records_.note(number).marked = clock_.steps();
  }
  settled_ = std::move(damage);
  found.springs = soft_springs();
  found.particles = soft_particles();
  found.cells = soft_cells();
  for (const std::uint32_t number : records_.order()) records_.set_damage(number, accepted[number]);
  return found;
}

void DamageField::accept_search(double time) {
  if (settled_.empty()) return;
  for (const std::uint32_t number : records_.order()) {
    records_.note(number).rests_until = 0;
    records_[number].rate = 0;
    note_elongations(number);
  }
  note_extensions();
  settled_.resize(records_.numbers(), 0);
  set_damages(settled_, time);
  forget_search();
}

double DamageField::grow_after_implicit(double time_step, double forward) {
  forward_ = forward;
  update(time_step);
  double growth = 0;
  for (const std::uint32_t number : records_.order())
    growth = std::max({growth, time_step * records_[number].rate, records_[number].lag});
  watch_all();
  finish();
  return growth;
}

}  // namespace hyperlattice
