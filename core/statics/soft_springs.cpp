// Springs that damage softens (state/damage_field.hpp): a factor of their stiffness remains, of a
// base spring only while it is stretched. They are few, so that they are computed one by one.
#include <state/damage_field.hpp>
#include <statics/spring_rows.hpp>
#include <statics/statics.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

/// Least part of a stiffness in the tangent, so that equations of particles of which nothing
/// remains have a solution. Forces do not have it, so that states of rest do not depend on it.
constexpr double least_tangent = 1e-6;

/// What remains of the stiffness of a spring that is stretched, and of one that is compressed.
struct SoftParts {
  double stretched = 1, compressed = 1;
  double at(double elongation) const { return elongation > 0 ? stretched : compressed; }
};

/// Returns the answer of a soft spring. In a step in time its force is the change of its energy
/// over the change of its elongation, so that a crack that closes within the step gains no energy;
/// with numerical damping it moves on towards the force at the end.
LinearisedSpring soft_answer(double stiffness, const SoftParts& parts, const StepElongations& at,
                             double forward) {
  const auto force = [&](double e) { return stiffness * parts.at(e) * e; };
  const auto energy = [&](double e) { return 0.5 * e * force(e); };
  const double way = at.end - at.start;
  if (way == 0 || parts.at(at.start) == parts.at(at.end))
    return {force(at.mean), stiffness * parts.at(at.end), energy(at.mean)};
  const double late = 2 * forward - 1, mean = (energy(at.end) - energy(at.start)) / way;
  return {
      (1 - late) * mean + late * force(at.end),
      ((1 - late) * (force(at.end) - mean) / way + late * stiffness * parts.at(at.end)) / forward,
      energy(at.mean)};
}

}  // namespace

void Statics::take_soft(const std::vector<SoftSpring>& springs,
                        const std::vector<SoftParticle>& particles,
                        const std::vector<SoftCell>& cells) {
  cell_remains_.clear();
  if (!cells.empty()) cell_remains_.assign(static_cast<std::size_t>(problem_.grid.places), 1);
  for (const SoftCell& cell : cells) {
    const auto place = static_cast<std::size_t>(place_of(cell.lowest));
    cell_modulus_[place] = model_.volumetric.modulus(model_.body.site(cell.lowest));
    cell_remains_[place] = cell.factor;
  }
  for (const Soft& soft : soft_) weight_[soft.at] = soft.weight;
  soft_.clear();
  soft_alphas_.clear();
  soft_.reserve(springs.size());
  for (const SoftSpring& spring : springs) {
    const std::int64_t place = place_of(spring.a);
    const std::size_t at = spring.neighbour * static_cast<std::size_t>(problem_.grid.places) +
                           static_cast<std::size_t>(place);
    soft_.push_back({place, place_of(spring.b) - place, at, weight_[at],
                     model_.spring_properties(spring.a, spring.b, spring.neighbour),
                     spring.factor});
    weight_[at] = 0;
  }
  soft_alphas_.reserve(particles.size());
  for (const SoftParticle& soft : particles)
    soft_alphas_.push_back(
        {place_of(soft.particle), (1 - soft.alpha_factor) *
                                      model_.kinds.alphas[model_.kinds.of(soft.particle)] *
                                      model_.body.share(soft.particle)});
}

double Statics::respond_soft(const double* u, double* force, const SpringTangents* tangents) const {
  const StaticGrid& grid = problem_.grid;
  const std::size_t kinds = model_.springs.choice.membrane == KernelChoice::Membrane::none ? 1 : 2;
  RowBuffers buffer(grid, 1);
  SpringRow& row = buffer.springs;
  row.count = 1;
  double energy = 0;
  for (const Soft& soft : soft_) {
    buffer.weight[0] = soft.of.share;
    row.rest = soft.of.rest;
    row.rest_length = soft.of.rest_length_of(0);
    row.cross_rest_length = soft.of.rest_length_of(1);
    place_row(u, soft.place, soft.step, row);
    energy +=
        linearise_one(buffer, kinds, [&](std::size_t cross, double, const StepElongations& at) {
          const double whole = soft.of.stiffness_of(cross);
          LinearisedSpring found = soft_answer(
              whole, cross == 1 ? SoftParts{soft.factor, soft.factor} : SoftParts{soft.factor, 1},
              at, row.forward);
          found.tangent = std::max(found.tangent, least_tangent * whole);
          return found;
        });
    add_forces(buffer, grid, grid.places, soft.step, force + soft.place);
    // A compressed spring drives its ends aside. Particles of which next to nothing remains, and
    // which compressed springs hold within their layer, would buckle out of it: motions of dust
    // that end no state of rest. The forces are the true ones.
    if (buffer.pull[0] < 0) buffer.pull[0] *= soft.factor;
    if (tangents != nullptr) keep_tangents(buffer, grid.components == 4, soft.at, *tangents);
  }
  for (const SoftAlpha& alpha : soft_alphas_) {
    if (grid.components != 4) break;
    const auto place = static_cast<std::size_t>(alpha.place);
    const std::size_t height = 3 * static_cast<std::size_t>(grid.places) + place;
    force[height] += 2 * alpha.lost * u[height];
    energy -= alpha.lost * u[height] * u[height];
    if (tangents != nullptr) tangents->own[height] -= static_cast<float>(2 * alpha.lost);
  }
  return energy;
}

DamageFound Statics::grow_damage(const double* displacement, const DamageSearch& search) {
  const EquilibriumUpdate at = rest_at(search.share, displacement);
  const auto load = [&](double share) { return preload_ + share; };
  DamageBounds bounds;
  bounds.least_factor = load(search.least_share) / load(search.share);
  bounds.most_factor = load(search.most_share) / load(search.share);
  bounds.most_growth = search.most_growth;
  const SettledDamage found = simulation_.settle_damage(at.xyz, at.heights, bounds);
  take_soft(found.springs, found.particles, found.cells);
  return {std::clamp(found.factor * load(search.share) - preload_, search.least_share,
                     search.most_share),
          found.change};
}

void Statics::restore_damage() {
  simulation_.forget_damage_search();
  take_soft(simulation_.soft_springs(), simulation_.soft_particles(), simulation_.soft_cells());
}

}  // namespace hyperlattice
