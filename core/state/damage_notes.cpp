// Which particles the field of damage must follow: those beside springs above the alarm of their
// material.
#include <state/damage_field.hpp>

#include <cmath>

namespace hyperlattice {

namespace {

// Notes of a particle repeat after a few steps, so that particles that stay above their alarm cost
// no list in every step. Records live longer than that (DamageField::steps_followed).
constexpr std::uint64_t steps_between_notes = 16;
/// A wave takes two to three steps from one particle to the next, and damage many more.
constexpr std::uint64_t steps_between_watches = 4;

}  // namespace

/// Notes a particle if damage can grow there and it was not noted lately.
void DamageField::note(Block& block, Particle particle) const {
  const std::uint32_t record = records_.of(particle);
  if (record != DamageRecords::none &&
      records_.note(record).marked + steps_between_notes > clock_.steps())
    return;
  if (records_.has_field(particle)) block.noted.push_back(particle);
}

void DamageField::note(Block& block, const AlarmRow& springs) const {
  const double rest_length = model_.springs.neighbours[springs.neighbour].rest_length;
  for (std::size_t n = 0; n < springs.sites.size(); ++n) {
    const SpringEnds ends =
        blocks_.layout().spring(block, springs.row, springs.neighbour, springs.sites[n]);
    for (const Particle end : {ends.a, ends.b})
      if (springs.elongation[n] >
          model_.cohesive[model_.kinds.material(end)].stretch_alarm * rest_length)
        note(block, end);
  }
}

void DamageField::watch_shortening(Block& block) const {
  if (clock_.steps() % steps_between_watches != 0) return;
  double alarm = infinity;
  for (const Cohesive& material : model_.cohesive)
    if (material.stage != nullptr) alarm = std::min(alarm, material.shortening_alarm);
  if (std::isfinite(alarm)) watch(block, infinity, alarm);
}

/// Notes both ends of springs that are stretched or shortened beyond these parts of their length.
void DamageField::watch(Block& block, double stretch, double shortening) const {
  std::vector<GrowthBounds> bounds;
  for (const NeighbourGeometry& to : model_.springs.neighbours) {
    const double square = to.rest_length * to.rest_length;
    bounds.push_back(
        {std::isfinite(shortening) ? square * ((1 - shortening) * (1 - shortening) - 1) : -infinity,
         square * ((1 + stretch) * (1 + stretch) - 1)});
  }
  blocks_.layout().for_springs_beyond(block, bounds, [&](const SpringPlace& spring) {
    for (const Particle end : {spring.ends.a, spring.ends.b}) note(block, end);
  });
}

/// Makes records of the particles that were noted.
void DamageField::follow_noted() {
  std::vector<Particle> noted;
  for (Block& block : blocks_) {
    noted.insert(noted.end(), block.noted.begin(), block.noted.end());
    block.noted.clear();
  }
  if (!noted.empty()) {
    records_.add(noted);
    for (const Particle particle : noted)
      records_.note(records_.of(particle)).marked = clock_.steps();
  }
}

/// Removes the records of particles that have no damage, nor a neighbour with damage, and whose
/// springs have been below their alarm for long.
void DamageField::remove_idle() {
  records_.remove_if([this](std::uint32_t number) {
    return !(records_.damage(number) > 0) &&
           records_.note(number).marked + steps_followed <= clock_.steps() &&
           !touches_damage(records_[number]);
  });
}

}  // namespace hyperlattice
