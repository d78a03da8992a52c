#include <model/build.hpp>
#include <model/spring_lattice.hpp>
#include <model/strain_energy.hpp>
#include <model/surface_alarm.hpp>

#include <hyperlattice/chance.hpp>
#include <hyperlattice/elastic_solid.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <numbers>

namespace hyperlattice {

namespace {

using std::numbers::pi;
/// Energy of a crack's plane over that of the continuum, mean of all directions, per h / b.
constexpr double lattice_energy = 0.175;

/// Returns the chances of the strongest and of the weakest particle of a material.
std::pair<double, double> extreme_chances(const Model& model, const Cohesive& of) {
  double least = 1, largest = 0;
  for (Particle p = 0; p < model.body.particles; ++p) {
    if (model.kinds.material(p) != of.material) continue;
    const double own = chance(of.seed, p, p);
    least = std::min(least, own);
    largest = std::max(largest, own);
  }
  return {least, largest};
}

/// Returns the strength, Pa, to a chance between 0 and 1.
double strength_at(const Cohesive& of, double chance) {
  return of.strength * std::pow(-std::log(chance), 1 / of.weibull_modulus) /
         std::tgamma(1 + 1 / of.weibull_modulus);
}

/// Adds a fault for each property of a material or of its body that damage does not know.
void check_support(const Model& model, const Material& material, Faults& faults) {
  const Stage& stage = *material.surface->stage;
  const auto refuse = [&](const Stage& at, std::string expected) {
    faults.add(at.pointer, at.component->type(), std::move(expected));
  };
  if (model.body.is_listed())
    return refuse(
        stage,
        "a criterion of springs: a list of springs has no field of damage, because the "
        "stress of its particles scatters in a body under an even load; the cubic lattice "
        "of 18 neighbours has one");
  const LatticeGeometry geometry = geometry_from(model.body);
  LatticeFacts facts = facts_of(geometry);
  facts.neighbours = model.body.neighbours;
  if (!elastic_solid::is_cubic_of_18(facts))
    return refuse(stage,
                  "a criterion of springs: only the cubic lattice of 18 neighbours has a "
                  "field of damage");
  if (model.springs.laws.size() > 1)
    refuse(stage, "one law for all materials of a body with a field of damage");
  const KernelSet& kernels = model.springs.laws[material.law].kernels;
  if (!kernels.linear || kernels.memory > 0)
    refuse(*material.stage, "a material with linear elastic springs beside a field of damage");
  if (model.springs.choice.membrane == KernelChoice::Membrane::clamped)
    refuse(*material.stage,
           "no membrane, or one that can move in the fourth dimension: a field of damage does not "
           "soften clamped ones");
}

/// Adds a fault if the length does not fit the strength or the spacing.
void check_length(const Model& model, const Cohesive& of, Faults& faults) {
  constexpr double round_off = 1e-9, enough = 3;
  const double spacing = model.body.grid.spacing,
               longest = of.largest_length(of.largest_strength, spacing),
               shortest = of.allow_coarse ? 0 : enough * spacing;
  const std::string scatter =
      of.weibull_modulus > 0
          ? fmt::format(" (the strongest particle has {:.4g} Pa)", of.largest_strength)
          : "";
  if (!(longest > 0) || longest < shortest * (1 - round_off)) {
    // the spacing and the strength whose longest length has enough spacings
    const double unit = (longest + lattice_energy * spacing),
                 most = unit / (enough + lattice_energy);
    const std::string reason =
        longest > 0 ? fmt::format(
                          "the length of damage is at most {:.4g} m, and must be at least "
                          "{:g} spacings or allow_coarse true",
                          longest, enough)
                    : std::string("no length of damage fits");
    faults.add(of.stage->pointer + "/strength", fmt::format("{:.6g} Pa", of.strength),
               fmt::format("at most {:.4g} Pa, or a spacing of at most {:.4g} m, or a "
                           "fracture_energy of at least {:.4g} J/m2{}: with those of this scene {}",
                           of.strength * std::sqrt(most / spacing), most,
                           of.fracture_energy * spacing / most, scatter, reason));
    return;
  }
  if (of.length > longest * (1 + round_off))
    faults.add(
        of.stage->pointer + "/length", fmt::format("{:.6g} m", of.length),
        fmt::format("at most {:.4g} m{}, or a strength of at most {:.4g} Pa", longest, scatter,
                    of.strength / of.largest_strength * of.largest_admissible_strength()));
  else if (of.length < shortest * (1 - round_off))
    faults.add(
        of.stage->pointer + "/length", fmt::format("{:.6g} m", of.length),
        fmt::format("at least {:g} spacings, {:.4g} m, or allow_coarse true", enough, shortest));
}

Cohesive constants_of(const Model& model, std::uint8_t number) {
  const Material& material = model.materials[number];
  Cohesive of;
  of.material = number;
  of.stage = material.surface->stage;
  of.surface = material.surface->component.get();
  CohesiveInputs inputs;
  of.stage->functions<FailureFunctions>().surface.inputs(of.surface, inputs);
  of.strength = of.least_strength = of.largest_strength = inputs.strength;
  of.fracture_energy = inputs.fracture_energy;
  of.weibull_modulus = inputs.weibull_modulus;
  of.seed = inputs.seed;
  of.allow_coarse = inputs.allow_coarse;
  of.intact_near_supports = inputs.intact_near_supports;
  if (of.weibull_modulus > 0) {
    const auto [least, largest] = extreme_chances(model, of);
    of.largest_strength = strength_at(of, least);
    of.least_strength = strength_at(of, largest);
  }
  const Grid& grid = model.body.grid;
  const SpringLattice lattice(geometry_from(grid), material.constants);
  const ElasticConstants elastic =
      mean_constants(layer_stiffness(lattice.endless(), grid.site_volume));
  of.modulus = elastic.C11;
  of.bulk_modulus = (elastic.C11 + 2 * elastic.C12) / 3;
  of.wave_speed = std::sqrt(of.modulus / material.constants.density);
  of.length =
      inputs.length > 0 ? inputs.length : of.largest_length(of.largest_strength, grid.spacing);
  if (!(of.length > 0)) return of;
  of.corrected = of.fracture_energy / (1 + lattice_energy * grid.spacing / of.length);
  of.viscosity = 0.5 * of.length / of.wave_speed;
  const SurfaceAlarm alarm = surface_alarm(lattice.geometry().neighbours, elastic,
                                           [&](std::span<const PrincipalStress> stresses,
                                               double* ratios) { of.ratios(stresses, ratios); });
  const double weakest = of.least_strength / of.strength;
  of.stretch_alarm = weakest * alarm.stretch;
  of.shortening_alarm = weakest * alarm.shortening;
  return of;
}

}  // namespace

double Cohesive::shape(double sigma) const { return energy_unit() * modulus / (sigma * sigma); }

double Cohesive::strength_of(std::uint64_t particle) const {
  return weibull_modulus > 0 ? strength_at(*this, chance(seed, particle, particle)) : strength;
}

void Cohesive::ratios(std::span<const PrincipalStress> stresses, double* ratios) const {
  call(*stage, "ratio", [&](const Complaint& why) {
    return stage->functions<FailureFunctions>().surface.ratios(surface, stresses, ratios, why);
  });
}

double Cohesive::energy_unit() const { return 2 * corrected / (pi * length); }

double Cohesive::zone() const { return pi * length / 2; }

double Cohesive::softening_zone() const {
  const double mu = 0.75 * (modulus - bulk_modulus), plane = 4 * mu * (modulus - mu) / modulus;
  return plane * corrected / (strength * strength);
}

double Cohesive::largest_admissible_strength() const {
  return std::sqrt(energy_unit() * modulus / least_shape);
}

double Cohesive::largest_length(double sigma, double spacing) const {
  return 8 * modulus * fracture_energy / (3 * pi * sigma * sigma) - lattice_energy * spacing;
}

void set_cohesive(Model& model, Faults& faults) {
  const auto has_surface = [](const Material& material) { return material.surface.has_value(); };
  if (std::none_of(model.materials.begin(), model.materials.end(), has_surface)) return;
  for (const Material& material : model.materials)
    if (material.surface) check_support(model, material, faults);
  if (!faults.empty()) return;
  CohesiveMaterials cohesive(model.materials.size());
  for (std::size_t n = 0; n < cohesive.size(); ++n) {
    const auto number = static_cast<std::uint8_t>(n);
    cohesive[n].material = number;
    if (!model.materials[n].surface) continue;
    cohesive[n] = constants_of(model, number);
    check_length(model, cohesive[n], faults);
  }
  if (!faults.empty()) return;
  model.cohesive = std::move(cohesive);
}

}  // namespace hyperlattice
