#include <plan/fields.hpp>

#include <hyperlattice/fields.hpp>
#include <hyperlattice/output.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

const FieldInfo* find_in(std::span<const FieldInfo> fields, std::string_view name) {
  const auto found = std::find_if(fields.begin(), fields.end(),
                                  [&](const FieldInfo& field) { return field.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

}  // namespace

const FieldInfo* field_of(const Model& model, std::string_view name) {
  if (const FieldInfo* field = find_field(name)) return field;
  for (const Law& law : model.springs.laws)
    if (const FieldInfo* field = find_in(law.stage->component->info.fields, name)) return field;
  return nullptr;
}

std::vector<std::string_view> fields_of(const Model& model) {
  std::vector<std::string_view> names;
  for (const std::string_view name : field_names)
    if (has_field(model, name)) names.push_back(name);
  for (const Law& law : model.springs.laws)
    for (const FieldInfo& field : law.stage->component->info.fields)
      if (std::find(names.begin(), names.end(), field.name) == names.end())
        names.push_back(field.name);
  return names;
}

bool has_field(const Model& model, std::string_view name) {
  const FieldInfo* field = field_of(model, name);
  if (field == nullptr) return false;
  switch (field->needs) {
    case FieldNeeds::list:
      return model.body.is_listed();
    case FieldNeeds::free_membrane:
      return model.degrees_of_freedom == 4;
    case FieldNeeds::failure:
      return model.springs.breakable || model.springs.softens;
    case FieldNeeds::damage:
      return !model.cohesive.empty();
    default:
      return true;
  }
}

bool is_measured(std::string_view name) {
  const FieldInfo* field = find_field(name);
  return field != nullptr && field->is_measured;
}

bool is_of_particle(std::string_view name) {
  constexpr std::string_view moving[] = {"displacement", "velocity", "height"};
  return is_one_of(moving, name) || is_constant_field(name);
}

namespace {

/// Returns the field that an option names, alone or with one of its components; null if it names
/// none.
const FieldInfo* named_field(const Scene& scene, std::string_view name) {
  for (const Stage* material : scene.of(Family::materials))
    if (const FieldInfo* field = find_in(material->component->info.fields, name)) return field;
  return find_field_part(name).field;
}

/// Calls visit(field, value, pointer) for each value of an option of the output that names a field.
template <class Visit>
void for_named_fields(const Scene& scene, const Stage& output, const nlohmann::json& resolved,
                      const Visit& visit) {
  const auto consider = [&](const nlohmann::json& value, const std::string& pointer) {
    if (!value.is_string()) return;
    if (const FieldInfo* field = named_field(scene, value.get_ref<const std::string&>()))
      visit(*field, value, pointer);
  };
  const auto& stage = resolved.at(nlohmann::json::json_pointer(output.pointer));
  for (const Option& option : output.component->info.options) {
    if (option.kind != OptionKind::texts && option.kind != OptionKind::choice &&
        option.kind != OptionKind::text)
      continue;
    const auto value = stage.find(option.name);
    if (value == stage.end()) continue;
    const std::string pointer = output.pointer + "/" + std::string(option.name);
    if (!value->is_array()) consider(*value, pointer);
    for (std::size_t n = 0; value->is_array() && n < value->size(); ++n)
      consider((*value)[n], pointer + "/" + std::to_string(n));
  }
}

std::vector<std::string> asked_by(const Scene& scene, const Stage& output,
                                  const nlohmann::json& resolved) {
  std::vector<std::string> asked;
  for_named_fields(scene, output, resolved,
                   [&](const FieldInfo& field, const nlohmann::json&, const std::string&) {
                     if (std::find(asked.begin(), asked.end(), field.name) == asked.end())
                       asked.emplace_back(field.name);
                   });
  return asked;
}

}  // namespace

AskedFields asked_fields(const Scene& scene) {
  AskedFields asked;
  const auto resolved = nlohmann::json::parse(scene.resolved);
  for (const Family family : {Family::writers, Family::probes})
    for (const Stage* output : scene.of(family)) asked[output] = asked_by(scene, *output, resolved);
  return asked;
}

void check_fields(const Model& model, Faults& faults) {
  const Scene& scene = *model.scene;
  const auto resolved = nlohmann::json::parse(scene.resolved);
  for (const Family family : {Family::writers, Family::probes})
    for (const Stage* output : scene.of(family))
      for_named_fields(
          scene, *output, resolved,
          [&](const FieldInfo& field, const nlohmann::json& value, const std::string& pointer) {
            if (has_field(model, field.name)) return;
            faults.add(
                pointer, value.dump(),
                fmt::format("a field that this run has: {}", fmt::join(fields_of(model), ", ")));
          });
}

}  // namespace hyperlattice
