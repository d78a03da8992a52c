#include <model/critical_step.hpp>
#include <model/mass_scaling.hpp>
#include <model/neighbour_pairs.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace hyperlattice {

namespace {

std::vector<double> bounds_of_cells(const Model& model) {
  std::vector<double> of_material;  // of a whole particle
  for (std::size_t n = 0; n < model.materials.size(); ++n)
    of_material.push_back(cell_bound(model, static_cast<std::uint8_t>(n)) * model.kinds.masses[n]);
  const Mixtures& mixtures = model.kinds.mixtures;
  std::vector<double> bounds;
  bounds.reserve(model.body.particles);
  for (Particle p = 0; p < model.body.particles; ++p) {
    const std::uint32_t kind = model.kinds.of(p);
    if (kind < of_material.size()) {
      bounds.push_back(model.body.share(p) * of_material[kind]);
      continue;
    }
    double sum = 0;
    mixtures.for_cells(kind, {}, [&](std::uint8_t material, double share) {
      sum += share / 8 * of_material[material];
    });
    bounds.push_back(sum);
  }
  return bounds;
}

/// The springs inside one material are a part of an infinite lattice of it, and all others are
/// counted one by one.
std::vector<double> bounds_of_particles(const Model& model) {
  const Body& body = model.body;
  const KernelChoice::Membrane membrane = model.springs.choice.membrane;
  std::vector<StiffnessBound> others(body.particles);
  std::vector<std::uint8_t> inside(body.particles);  // 1: it has springs inside its material
  for_neighbour_pairs(model, [&](Particle a, Particle b, std::uint32_t n) {
    if (model.kinds.of(a) == model.kinds.of(b)) {
      inside[a] = inside[b] = 1;
      return;
    }
    const NeighbourGeometry& to = model.springs.neighbours[n];
    const SpringConstants& spring =
        model.springs.spring_to(n, model.kinds.of(a), model.kinds.of(b));
    others[a].add(to, 1, spring, body.grid.membrane_distance, membrane);
    others[b].add(to, -1, spring, body.grid.membrane_distance, membrane);
  });
  std::vector<double> bounds;
  bounds.reserve(body.particles);
  for (Particle p = 0; p < body.particles; ++p) {
    double bound = others[p].value();
    if (inside[p] != 0) {
      const Material& material = model.materials[model.kinds.material(p)];
      bound += 4 * material.mass / (material.critical_time_step * material.critical_time_step);
    }
    bounds.push_back(bound);
  }
  return bounds;
}

/// Returns the bounds of what loads answer, by particle.
std::vector<LoadStiffnessBound> answers(const Model& model) {
  std::vector<LoadStiffnessBound> sums(model.body.particles);
  for (const Load& load : model.loads)
    for (const WatchedParticle& watched : load.watched) {
      sums[watched.particle].stiffness += watched.reaction.stiffness;
      sums[watched.particle].viscosity += watched.reaction.viscosity;
    }
  return sums;
}

}  // namespace

std::string objection_to_mass_scaling(const Model& model, double time_step) {
  if (model.degrees_of_freedom == 4)
    return "the membrane \"none\" or one that holds its heights, whose inertia is not scaled";
  if (!model.volumetric.empty() && model.body.cells.empty() && model.materials.size() > 1)
    return "a lattice of cells, or materials without a volumetric energy: cells between particles "
           "of several materials have no bound of their own";
  if (stable_step_of_laws(model, time_step) < time_step * (1 - 1e-9))
    return "laws without viscosity: mass alone does not lengthen their stable step";
  return {};
}

std::vector<double> stiffness_bounds(const Model& model) {
  if (model.body.is_listed()) return listed_bounds(model);
  return model.body.cells.empty() ? bounds_of_particles(model) : bounds_of_cells(model);
}

MassScaling::MassScaling(const Model& model, double time_step) : time_step_(time_step) {
  constexpr double round_off = 1e-9;
  const std::vector<double> bounds = stiffness_bounds(model);
  const std::vector<LoadStiffnessBound> answer =
      model.loads.answering ? answers(model) : std::vector<LoadStiffnessBound>();
  for (Particle p = 0; p < model.body.particles; ++p) {
    const double mass = model.mass(p),
                 stiffness = bounds[p] + (answer.empty() ? 0 : answer[p].stiffness),
                 viscosity = answer.empty() ? 0 : answer[p].viscosity;
    const double needed = 0.25 * time_step * time_step * stiffness + 0.5 * time_step * viscosity;
    body_ += mass;
    if (!(needed > mass * (1 + round_off))) continue;
    particles_.push_back({p, needed - mass});
    added_ += needed - mass;
    largest_ratio_ = std::max(largest_ratio_, needed / mass);
  }
}

}  // namespace hyperlattice
