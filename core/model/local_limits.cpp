#include <model/critical_step.hpp>
#include <model/local_limits.hpp>
#include <model/neighbour_pairs.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

std::string objection_to_local_steps(const Model& model) {
  if (model.body.is_listed()) return "a structured lattice";
  if (!model.volumetric.empty())
    return "materials without a volumetric energy: cells join particles that take different steps";
  if (model.degrees_of_freedom == 4) return "the membrane \"none\" or one that holds its heights";
  if (!model.cohesive.empty()) return "materials that are not cohesive";
  if (model.springs.memory > 0) return "laws without a memory";
  if (model.springs.laws.size() > 1 || !model.springs.composites.empty())
    return "materials of one law";
  return {};
}

LocalLimits::LocalLimits(const Model& model) {
  const Body& body = model.body;
  std::vector<StiffnessBound> bounds(body.particles);
  std::vector<std::uint8_t> alike(body.particles, 1);  // all springs of its own material
  for_neighbour_pairs(model, [&](Particle a, Particle b, std::uint32_t n) {
    const SpringProperties properties = model.spring_properties(a, b, n);
    SpringConstants spring = model.springs.spring_to(n, model.kinds.of(a), model.kinds.of(b));
    spring.stiffness = properties.share * properties.stiffness;
    spring.cross_stiffness = properties.share * properties.cross_stiffness;
    for (const auto& [particle, side] : {std::pair{a, 1}, {b, -1}})
      bounds[particle].add(model.springs.neighbours[n], side, spring, body.grid.membrane_distance,
                           model.springs.choice.membrane);
    if (model.kinds.of(a) != model.kinds.of(b)) alike[a] = alike[b] = 0;
  });
  for (Particle p = 0; p < body.particles; ++p) {
    const double stiffness = bounds[p].value(),
                 bound = stiffness > 0 ? 2 / std::sqrt(stiffness / model.mass(p)) : infinity;
    const bool inside = alike[p] != 0 && body.cells.empty();
    steps_.push_back(
        inside ? std::max(bound, model.materials[model.kinds.material(p)].critical_time_step)
               : bound);
  }
  sorted_ = steps_;
  std::sort(sorted_.begin(), sorted_.end());
}

/// Returns how many particles have a shorter step.
std::uint64_t LocalLimits::below(double step) const {
  return static_cast<std::uint64_t>(std::lower_bound(sorted_.begin(), sorted_.end(), step) -
                                    sorted_.begin());
}

LocalSteps LocalLimits::divide(std::int64_t parts) const {
  // Measured: a local step of a particle takes about four times as long as one in a kernel.
  constexpr double dear = 4, round_off = 1e-9;
  const double shortest = sorted_.front(), longest = sorted_.back();
  const auto with = [&](std::int64_t number) {
    LocalSteps steps;
    steps.parts = number;
    steps.time_step = std::min(static_cast<double>(number) * shortest, longest);
    steps.share = static_cast<double>(below(steps.time_step * (1 - round_off))) /
                  static_cast<double>(sorted_.size());
    if (number > 1) steps.cost += dear * static_cast<double>(number) * steps.share;
    return steps;
  };
  if (parts > 0) return with(parts);
  LocalSteps best = with(1);
  double last = 0;
  for (const double step : sorted_) {  // each group of particles at its own limit
    if (!(step > last * 1.01) || !(step < infinity)) continue;
    last = step;
    const LocalSteps found =
        with(static_cast<std::int64_t>(std::floor(step / shortest * (1 + round_off))));
    if (found.cost / found.time_step < best.cost / best.time_step) best = found;
  }
  return best;
}

}  // namespace hyperlattice
