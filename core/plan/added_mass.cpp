#include <base/figures.hpp>
#include <plan/added_mass.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace hyperlattice {

namespace {

void refuse(const PlannedStage& planned, const std::string& expected, Faults& faults) {
  faults.add(planned.stage->pointer + "/mass_scaling",
             fmt::format("{:.6g} s", planned.stage->mass_scaling), expected);
}

double share_of_particles(const MassScaling& scaling, const Model& model) {
  return static_cast<double>(scaling.particles().size()) /
         static_cast<double>(model.body.particles);
}

/// A motion gets slower by sqrt(1 + e), with e the kinetic energy of the added mass over that of
/// the body: the share of the mass if all particles move alike.
std::string effect_of(const MassScaling& scaling) {
  if (scaling.particles().empty()) return "no particle needs mass";
  return fmt::format(
      "motions in which all particles move alike are {:.3g} % slower, those of the particles with "
      "added mass up to {:.3g} times; states of rest and weights stay",
      100 * (std::sqrt(1 + scaling.share()) - 1), std::sqrt(scaling.largest_ratio()));
}

}  // namespace

void add_mass(PlannedStage& planned, const Model& model, Faults& faults) {
  const double time_step = planned.stage->mass_scaling;
  if (!(time_step > 0)) return;
  if (const std::string objection = objection_to_mass_scaling(model, time_step); objection.empty())
    planned.mass_scaling.emplace(model, time_step);
  else
    refuse(planned, "left out, or " + objection, faults);
}

void check_added_mass(const PlannedStage& planned, Faults& faults) {
  const SolverPlan& plan = planned.plan;
  if (!planned.mass_scaling) return;
  if (plan.at_rest || !std::isfinite(plan.stable_time_step))
    refuse(planned,
           "left out of " + planned.stage->component->type() +
               ": added mass lengthens only steps in time that have a critical one",
           faults);
  else if (plan.local.parts > 1)
    refuse(planned, "left out, or local_steps 1: both lengthen the step of stiff particles",
           faults);
}

std::string added_mass_warning(const PlannedStage& planned) {
  constexpr double most = 0.05;
  if (!planned.mass_scaling || planned.plan.damping > 0 || planned.mass_scaling->share() < most)
    return {};
  return fmt::format(
      "mass_scaling of {} ({}) adds {:.3g} % of the body's mass, which slows motions of the whole "
      "body; without damping take at most {:.3g} %",
      planned.stage->name, planned.stage->pointer, 100 * planned.mass_scaling->share(), 100 * most);
}

nlohmann::json added_mass_json(const MassScaling& scaling, const Model& model) {
  return {{"critical_time_step", scaling.time_step()},
          {"particles", scaling.particles().size()},
          {"share_of_particles", share_of_particles(scaling, model)},
          {"mass", scaling.added()},
          {"share_of_mass", scaling.share()},
          {"largest_ratio", scaling.largest_ratio()},
          {"effect", effect_of(scaling)}};
}

std::string added_mass_text(const MassScaling& scaling, const Model& model) {
  if (scaling.particles().empty()) return effect_of(scaling);
  return fmt::format(
      "{} particles ({:.3g} %) get {:.4g} kg, {:.3g} % of the body's mass, at most {:.3g} times "
      "their own: {}",
      count_text(scaling.particles().size()), 100 * share_of_particles(scaling, model),
      scaling.added(), 100 * scaling.share(), scaling.largest_ratio(), effect_of(scaling));
}

}  // namespace hyperlattice
