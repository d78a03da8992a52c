#include <plan/fields.hpp>

#include <hyperlattice/output.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace hyperlattice {

bool has_field(const Model& model, std::string_view name) {
  const FieldInfo* field = find_field(name);
  if (field == nullptr) return false;
  switch (field->needs) {
    case FieldNeeds::list:
      return model.body.is_listed();
    case FieldNeeds::free_membrane:
      return model.degrees_of_freedom == 4;
    case FieldNeeds::failure:
      return model.springs.breakable || model.springs.softens;
    default:
      return true;
  }
}

bool is_measured(std::string_view name) {
  const FieldInfo* field = find_field(name);
  return field != nullptr && field->is_measured;
}

namespace {

std::vector<std::string> asked_by(const Stage& output, const nlohmann::json& resolved) {
  std::vector<std::string> asked;
  const auto consider = [&](const nlohmann::json& value) {
    if (!value.is_string()) return;
    const FieldInfo* field = find_field_part(value.get_ref<const std::string&>()).field;
    if (field != nullptr && std::find(asked.begin(), asked.end(), field->name) == asked.end())
      asked.emplace_back(field->name);
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
