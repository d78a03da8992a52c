#include <model/arithmetic.hpp>
#include <plan/added_mass.hpp>
#include <plan/coordination.hpp>
#include <plan/damage.hpp>
#include <plan/estimates.hpp>
#include <scene/common_options.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

/// Returns the plugins of the scene's stages, each once.
nlohmann::json plugins_json(const Scene& scene) {
  auto list = nlohmann::json::array();
  const auto add = [&](const Component& component) {
    const nlohmann::json entry = {{"name", component.plugin},
                                  {"version", component.version},
                                  {"path", component.path.string()}};
    if (std::find(list.begin(), list.end(), entry) == list.end()) list.push_back(entry);
  };
  for (const Stage& stage : scene.stages) {
    add(*stage.component);
    for (const Stage& failure : stage.failures) add(*failure.component);
  }
  return list;
}

const char* motion_name(KernelChoice::Membrane membrane) {
  switch (membrane) {
    case KernelChoice::Membrane::none:
      return "none";
    case KernelChoice::Membrane::clamped:
      return "clamped";
    default:
      return "free";
  }
}

/// Returns the membrane's name in the scene; if materials have different membranes, all names.
std::string membrane_name(const Model& model) {
  const auto resolved = nlohmann::json::parse(model.scene->resolved);
  std::vector<std::string> names;
  for (const Material& material : model.materials) {
    const auto& stage = resolved.at(nlohmann::json::json_pointer(material.stage->pointer));
    const auto name = stage.find("membrane");
    if (name == stage.end() || !name->is_string() ||
        std::find(names.begin(), names.end(), *name) != names.end())
      continue;
    names.push_back(*name);
  }
  return names.empty() ? motion_name(model.springs.choice.membrane)
                       : fmt::format("{}", fmt::join(names, ", "));
}

/// Returns the size of the body, and that of its shape where it is known.
nlohmann::json body_json(const BodyFigures& body) {
  const auto vector = [](Vec3 v) { return nlohmann::json{v.x, v.y, v.z}; };
  nlohmann::json json = {{"size", vector(body.size)},
                         {"volume", body.volume},
                         {"mass", body.mass},
                         {"parts", body.parts.count},
                         {"cut_springs", body.cut_springs},
                         {"loose_particles", body.parts.loose}};
  if (body.is_partial) {
    json["cells"] = body.cells;
    json["partial_cells"] = body.partial_cells;
  }
  if (body.asked_size)
    json[body.asked_at_most ? "asked_size_at_most" : "asked_size"] = vector(*body.asked_size);
  if (body.asked_volume) json["asked_volume"] = *body.asked_volume;
  if (body.asked_mass) json["asked_mass"] = *body.asked_mass;
  return json;
}

/// Returns the facts that every plan has.
nlohmann::json common_facts(const Plan& plan) {
  const Model& model = *plan.model;
  double time_step = 0;
  auto stages = nlohmann::json::array();
  for (const PlannedStage& stage : plan.stages) {
    time_step = std::max(time_step, stage.plan.time_step);
    stages.push_back({{"type", stage.stage->component->type()},
                      {"name", stage.stage->name},
                      {"start_time", stage.start_time},
                      {"end_time", stage.plan.end_time},
                      {"steps", stage.plan.steps},
                      {"time_step", stage.plan.time_step},
                      {"stable_time_step", stage.plan.stable_time_step},
                      {"damping", stage.plan.damping},
                      {"at_rest", stage.plan.at_rest}});
    if (stage.mass_scaling)
      stages.back()["added_mass"] = added_mass_json(*stage.mass_scaling, model);
  }
  auto left_out = nlohmann::json::array();
  for (const LeftOut& left : plan.left_out)
    left_out.push_back({{"what", left.what}, {"why", left.why}});

  const double particles = static_cast<double>(model.body.particles),
               springs = static_cast<double>(model.body.base_springs());
  return {{"title", plan.scene->title},
          {"version", HYPERLATTICE_VERSION},
          {"particles", model.body.particles},
          {"body", body_json(plan.body)},
          {"springs", model.body.base_springs()},
          {"springs_per_particle", springs / particles},
          {"degrees_of_freedom", model.degrees_of_freedom},
          {"membrane", membrane_name(model)},
          {"fourth_dimension", motion_name(model.springs.choice.membrane)},
          {"volumetric", !model.volumetric.empty() || model.nodal_volumes},
          {"breakable", model.springs.breakable || model.springs.softens},
          {"materials", model.materials.size()},
          {"loads", model.loads.size()},
          {"precision", precision_names[static_cast<std::size_t>(model.springs.choice.precision)]},
          {"instructions", model.springs.kernels().instructions},
          {"spring_arithmetic", spring_arithmetic()},
          {"ranks", plan.ranks},
          {"threads", plan.threads},
          {"steps", plan.steps()},
          {"end_time", plan.end_time()},
          {"time_step", time_step},
          {"critical_time_step", model.step_limit.time_step},
          {"critical_because", model.step_limit.because},
          {"stages", stages},
          {"bytes_per_particle", plan.bytes_per_particle},
          {"memory_bytes", plan.memory_bytes},
          {"output_bytes", plan.output_bytes},
          {"expected_seconds", plan.expected_seconds},
          {"expected_seconds_at_most", plan.expected_seconds * slowest(model)},
          {"plugins", plugins_json(*plan.scene)},
          {"warnings", model.warnings},
          {"left_out", left_out}};
}

}  // namespace

nlohmann::json plan_json(const Plan& plan) {
  nlohmann::json facts = common_facts(plan);
  if (plan.start)
    facts["start"] = {{"file", plan.start->file.string()},
                      {"hash", plan.start->hash},
                      {"time", plan.start->time},
                      {"step", plan.start->steps}};
  if (!plan.model->cohesive.empty()) facts["damage"] = damage_json(*plan.model);
  if (!plan.model->body.is_listed()) return facts;
  const Coordination springs = coordination_of(plan.model->body);
  facts["springs_of_a_particle"] = {
      {"fewest", springs.fewest}, {"most", springs.most}, {"fewer_than_three", springs.swinging}};
  return facts;
}

}  // namespace hyperlattice
