#include <plan/fields.hpp>
#include <plan/left_out.hpp>

#include <hyperlattice/output.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <set>

namespace hyperlattice {

namespace {

/// Returns whether a failure criterion keeps numbers for springs.
bool criteria_remember(const Model& model) {
  for (const Material& material : model.materials)
    for (const Material::Criterion& criterion : material.failures)
      if (criterion.stage->functions<FailureFunctions>().memory > 0) return true;
  return false;
}

void leave_out_kernel_parts(const Plan& plan, std::vector<LeftOut>& out) {
  const Model& model = *plan.model;
  using Membrane = KernelChoice::Membrane;
  if (model.springs.choice.membrane == Membrane::none)
    out.push_back(
        {"fourth dimension", "the membrane is none: no spring leaves the three dimensions"});
  if (model.springs.choice.membrane == Membrane::clamped)
    out.push_back(
        {"motion in the fourth dimension",
         "the membrane is clamped: its cross springs act, but each particle keeps its height"});
  if (model.springs.choice.membrane != Membrane::none)
    out.push_back(
        {"second layer of the membrane",
         "it mirrors the first exactly, so one layer is computed" +
             (model.step_limit.two_layers_grow.empty()
                  ? ""
                  : "; two free ones would not stay so: " + model.step_limit.two_layers_grow)});
  if (model.volumetric.empty() && !model.nodal_volumes)
    out.push_back({"volumetric energy", "no material needs it for its Poisson ratio"});
  if (!model.springs.breakable)
    out.push_back({"failure", "no material names a failure law: no spring is tested"});
  if (model.cohesive.empty())
    out.push_back({"field of damage", "no material has a strength surface: no stress is watched"});
  if (model.springs.breakable && !criteria_remember(model))
    out.push_back({"memory of failure laws", "none keeps one: springs break by what they are now"});
  if (model.springs.memory == 0)
    out.push_back({"memory of springs", "no law has one: a spring is where its ends are"});
  if (model.springs.composites.empty())
    out.push_back({"springs of several laws",
                   "no spring joins materials with different laws or different constants"});
  if (model.materials.size() == 1)
    out.push_back({"mixed materials", "there is one material: no particle stores which"});
  const auto is_damped = [](const PlannedStage& stage) { return stage.plan.damping > 0; };
  if (std::none_of(plan.stages.begin(), plan.stages.end(), is_damped))
    out.push_back({"local damping", "no solver stage asks for it"});
  if (model.loads.acceleration == Vec3{})
    out.push_back({"body acceleration", "no load accelerates the whole body"});
  if (model.body.cells.empty() && model.body.listed.shares.empty())
    out.push_back({"weights at the surface",
                   "the boundary is particles: each particle and spring counts in full"});
  if (!model.body.is_listed())
    out.push_back({"list of springs",
                   "every site has the same neighbours, so springs are bits, not records"});
}

void leave_out_loads(const Plan& plan, std::vector<LeftOut>& out) {
  bool any_force = plan.model->loads.answering, any_motion = false;
  for (const Load& load : plan.model->loads)
    for (const LoadedParticle& particle : load.particles) {
      if (!(particle.force == Vec3{})) any_force = true;
      if (particle.displaced != 0 || particle.driven != 0) any_motion = true;
    }
  if (!any_force) out.push_back({"external forces", "no load applies one"});
  if (!plan.model->loads.answering)
    out.push_back({"forces that answer to the motion", "no load watches particles"});
  if (!any_motion) out.push_back({"prescribed motion", "no load prescribes any"});
}

void leave_out_outputs(const Plan& plan, std::vector<LeftOut>& out) {
  std::set<std::string, std::less<>> asked;
  std::size_t outputs = 0;
  for (const Family family : {Family::writers, Family::probes})
    for (const Stage* stage : plan.scene->of(family)) {
      ++outputs;
      const std::vector<std::string>& names = plan.asked_fields.at(stage);
      asked.insert(names.begin(), names.end());
    }
  if (plan.scene->of(Family::writers).empty())
    out.push_back({"writers", "the scene has none: only tables and the summary are written"});
  if (plan.scene->of(Family::probes).empty()) out.push_back({"probes", "the scene has none"});
  if (outputs == 0) return;
  if (std::none_of(asked.begin(), asked.end(), is_measured))
    out.push_back({"stress, strain and forces of particles",
                   "no writer or probe names a field that is computed from all springs"});
  std::vector<std::string_view> names(std::begin(field_names), std::end(field_names));
  for (const std::string_view name : fields_of(*plan.model))
    if (find_field(name) == nullptr) names.push_back(name);
  for (const std::string_view name : names) {
    if (is_measured(name)) continue;
    if (!has_field(*plan.model, name))
      out.push_back({fmt::format("field {}", name), "this run has no such quantity"});
    else if (asked.find(name) == asked.end())
      out.push_back({fmt::format("field {}", name), "no writer or probe names it"});
  }
}

}  // namespace

std::vector<LeftOut> left_out(const Plan& plan) {
  std::vector<LeftOut> out;
  leave_out_kernel_parts(plan, out);
  leave_out_loads(plan, out);
  leave_out_outputs(plan, out);
  out.push_back({"all other plugins", "a library is opened only if the scene names its type"});
  return out;
}

}  // namespace hyperlattice
