// What damage leaves of springs, as others see it.
#include <state/damage_field.hpp>

namespace hyperlattice {

std::optional<double> DamageField::factor(Particle first, std::uint32_t neighbour) const {
  const std::uint32_t number = records_.of(first);
  if (number == DamageRecords::none) return std::nullopt;
  for (const DamageSpring& spring : records_[number].springs())
    if (spring.forward && spring.neighbour == neighbour && spring.handed_over && spring.present)
      return in_series(records_.remaining(number), records_.remaining_of(spring.to));
  return std::nullopt;
}

std::vector<SoftSpring> DamageField::soft_springs() const {
  std::vector<SoftSpring> found;
  for (const std::uint32_t number : records_.order()) {
    const DamageRecord& record = records_[number];
    for (const DamageSpring& spring : record.springs())
      if (spring.forward && spring.present &&
          (spring.handed_over || records_.remaining(number) < 1 ||
           records_.remaining_of(spring.to) < 1))
        found.push_back({record.particle, spring.to, spring.neighbour,
                         in_series(records_.remaining(number), records_.remaining_of(spring.to))});
  }
  return found;
}

std::vector<SoftParticle> DamageField::soft_particles() const {
  std::vector<SoftParticle> found;
  for (const std::uint32_t number : records_.order())
    if (records_[number].alpha > 0 && records_.remaining(number) < 1)
      found.push_back({records_[number].particle, alpha_factor(records_.remaining(number))});
  return found;
}

}  // namespace hyperlattice
