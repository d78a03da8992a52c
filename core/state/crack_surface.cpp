// The energy of cracks is that of the phase field. Its gradient is the one of the equation of
// damage: sum_j s_ij (d_j - d_i)^2 / (2 h^2) at particle i, of which s_ij (d_j - d_i) / h^2 is the
// Laplacian. A crack along layers of particles, d = 1 - sin(|x| / b), has G_i per area.
#include <state/damage_field.hpp>

namespace hyperlattice {

CrackSurface DamageField::surface() const {
  const std::span<const std::uint32_t> order = records_.order();
  std::vector<CrackSurface> parts(order.size());
  records_.for_indices(order.size(), [&](std::size_t n) {
    const std::uint32_t number = order[n];
    const DamageRecord& record = records_[number];
    if (record.material == nullptr) return;
    const double d = records_.damage(number),
                 in_spacings = record.material->length / model_.body.grid.spacing;
    double squares = 0;
    for (const DamageSpring& spring : record.springs()) {
      const double rise = records_.damage_of(spring.to) - d;
      squares += spring.spread * rise * rise;
    }
    const double energy = record.volume * record.material->energy_unit() *
                          (d - d * d / 2 + in_spacings * in_spacings * squares / 4);
    parts[n] = {energy, energy / record.material->corrected};
  });
  CrackSurface found;
  for (const CrackSurface& part : parts) {
    found.energy += part.energy;
    found.area += part.area;
  }
  return found;
}

}  // namespace hyperlattice
