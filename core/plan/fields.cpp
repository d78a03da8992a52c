#include <plan/fields.hpp>

#include <hyperlattice/output.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace hyperlattice {

bool has_field(const Model& model, std::string_view name) {
  if (name == "displacement" || name == "velocity" || name == "material") return true;
  if (name == "source") return model.body.is_listed();
  if (name == "height") return model.degrees_of_freedom == 4;
  if (name == "broken_open" || name == "broken_closed" || name == "damage")
    return model.springs.breakable || model.springs.softens;
  return false;
}

namespace {

std::vector<std::string> asked_by(const Stage& output, const nlohmann::json& resolved) {
  std::vector<std::string> asked;
  const auto consider = [&](const nlohmann::json& value) {
    if (!value.is_string()) return;
    const auto& name = value.get_ref<const std::string&>();
    const bool is_field =
        std::find(std::begin(field_names), std::end(field_names), name) != std::end(field_names);
    if (is_field && std::find(asked.begin(), asked.end(), name) == asked.end())
      asked.push_back(name);
  };
  const auto& stage = resolved.at(nlohmann::json::json_pointer(output.pointer));
  for (const Option& option : output.component->info.options) {
    if (option.kind != OptionKind::texts && option.kind != OptionKind::choice &&
        option.kind != OptionKind::text)
      continue;
    const auto value = stage.find(option.name);
    if (value == stage.end()) continue;
    if (value->is_array())
      std::for_each(value->begin(), value->end(), consider);
    else
      consider(*value);
  }
  return asked;
}

}  // namespace

AskedFields asked_fields(const Scene& scene) {
  AskedFields asked;
  const auto resolved = nlohmann::json::parse(scene.resolved);
  for (const Family family : {Family::writers, Family::probes})
    for (const Stage* output : scene.of(family)) asked[output] = asked_by(*output, resolved);
  return asked;
}

}  // namespace hyperlattice
