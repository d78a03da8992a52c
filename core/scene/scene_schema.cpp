// The JSON Schema of a scene, from the declarations of components, shapes and common keys.
#include <geometry/primitives.hpp>
#include <scene/common_options.hpp>
#include <scene/cut_reader.hpp>
#include <scene/examples.hpp>
#include <scene/region_reader.hpp>
#include <scene/scene.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <set>

namespace hyperlattice {

namespace {

constexpr const char* number_with_unit =
    R"(^\s*[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?\s*[^\s0-9.,+-].*$|^\s*[-+]?[0-9.]+([eE][-+]?[0-9]+)?\s+1/.+$)";

Json reference(const std::string& definition) {
  return {{"$ref", fmt::format("#/$defs/{}", definition)}};
}

Json bounded(const Option& option, const char* type) {
  Json number{{"type", type}};
  if (option.low != -infinity)
    number[option.low_open ? "exclusiveMinimum" : "minimum"] = option.low;
  if (option.high != infinity)
    number[option.high_open ? "exclusiveMaximum" : "maximum"] = option.high;
  return number;
}

/// Returns the schema of a plain SI number, a text with a unit, or a text with a variable.
Json quantity(const Option& option) {
  return {{"anyOf", {bounded(option, "number"), reference("quantity"), reference("variable")}}};
}

/// Returns the schema of a value or a text with a variable, whose value the schema cannot see.
Json or_variable(Json value) { return {{"anyOf", {std::move(value), reference("variable")}}}; }

Json choices(const Option& option) {
  Json own{{"enum", std::vector<std::string>(option.choices.begin(), option.choices.end())}};
  if (!option.plugin_fields) return own;
  return {{"anyOf", {own, reference("plugin_field")}}};
}

/// Returns the schema of a name of a field that a material declares.
Json plugin_field(const std::vector<const Component*>& components) {
  std::set<std::string> names;
  for (const Component* component : components)
    for (const FieldInfo& field : component->info.fields) names.emplace(field.name);
  return names.empty() ? Json(false) : Json{{"enum", names}};
}

Json value_schema(const Option& option) {
  switch (option.kind) {
    case OptionKind::number:
      return quantity(option);
    case OptionKind::integer:
      return bounded(option, "integer");
    case OptionKind::boolean:
      return {{"type", "boolean"}};
    case OptionKind::text:
    case OptionKind::file:
      return {{"type", "string"}};
    case OptionKind::choice:
      return choices(option);
    case OptionKind::vector:
      return {{"type", "array"}, {"items", quantity(option)}, {"minItems", 3}, {"maxItems", 3}};
    case OptionKind::numbers:
      return {{"type", "array"}, {"items", quantity(option)}};
    case OptionKind::texts:
      return {{"type", "array"},
              {"items", option.choices.empty() ? Json{{"type", "string"}} : choices(option)}};
    case OptionKind::shape:
      return reference("solid");
    case OptionKind::region:
    case OptionKind::load_or_region:
      return reference("region");
  }
  return true;
}

Json option_schema(const Option& option) {
  Json value = or_variable(value_schema(option));
  if (!option.word.empty()) value = {{"anyOf", {std::move(value), {{"const", option.word}}}}};
  value["description"] = option.unit.empty() ? std::string(option.help)
                                             : fmt::format("{} [{}]", option.help, option.unit);
  if (!option.fallback.empty()) value["default"] = Json::parse(option.fallback);
  // Editors offer these values. A text, such as a name, is the user's own.
  const bool is_free = option.choices.empty() &&
                       (option.kind == OptionKind::text || option.kind == OptionKind::texts);
  if (!option.example.empty() || (option.fallback.empty() && !is_free))
    value["examples"] = Json::array({example_value(option, 0)});
  return value;
}

/// Declares the former names of an option as deprecated, so that an object has at most one of all
/// its names. Returns whether there are any.
bool declare_former(Json& object, const Option& option, std::span<const OldName> old_names,
                    bool required) {
  const auto has = [](std::string_view name) { return Json{{"required", Json::array({name})}}; };
  Json names = Json::array({has(option.name)});
  for (const OldName& old : old_names) {
    if (old.option != option.name) continue;
    Json& former = object["properties"][std::string(old.name)];
    if (old.values.empty()) former = option_schema(option);
    for (const OldValue& value : old.values) former["enum"].push_back(Json::parse(value.before));
    former["description"] = fmt::format("named \"{}\" since version {}", option.name, old.since);
    former["deprecated"] = true;
    names.push_back(has(old.name));
  }
  if (names.size() == 1) return false;
  const Json none{{"not", {{"anyOf", names}}}};
  if (!required) names.push_back(none);
  object["allOf"].push_back({{"oneOf", std::move(names)}});
  return true;
}

/// Adds options to the schema of an object.
void declare(Json& object, std::span<const Option> options, std::span<const OldName> old_names) {
  for (const Option& option : options) {
    object["properties"][std::string(option.name)] = option_schema(option);
    const bool required = option.fallback.empty() && !option.optional;
    if (!declare_former(object, option, old_names, required) && required)
      object["required"].push_back(option.name);
  }
}

Json object_schema(std::string_view description) {
  return {{"type", "object"},
          {"description", description},
          {"properties", Json::object()},
          {"required", Json::array()},
          {"additionalProperties", false}};
}

Json component_schema(const ComponentInfo& info) {
  Json object = object_schema(info.summary);
  object["examples"] = Json::array({example_stage(info)});
  object["properties"]["type"] = or_variable({{"const", info.name}});
  object["properties"]["type"]["description"] = info.summary;
  object["required"].push_back("type");
  declare(object, info.options, info.old_names);
  const OptionSet& common = common_options(info.family);
  declare(object, common.options, common.old_names);
  if (info.family == Family::materials) {
    object["properties"]["failure"] = reference("failure");
    object["properties"]["failure"]["description"] = failure_help;
  }
  if (info.family == Family::lattices)
    object["properties"][std::string(cuts_key)] = {
        {"type", "array"}, {"description", cuts_help}, {"items", or_variable(reference("cut"))}};
  return object;
}

/// Returns the schema of an object whose "type" is one of the types; the schema of that type then
/// applies.
Json one_of(const std::vector<std::string>& types) {
  if (types.empty()) return false;
  Json schema{{"type", "object"},
              {"required", {"type"}},
              {"properties", {{"type", or_variable({{"enum", types}})}}},
              {"allOf", Json::array()}};
  for (const std::string& type : types)
    schema["allOf"].push_back(
        {{"if", {{"properties", {{"type", {{"const", type}}}}}, {"required", {"type"}}}},
         {"then", reference(type)}});
  return or_variable(std::move(schema));
}

/// Returns the schema of a region expression: a name, a primitive, or a set of expressions of the
/// same definition.
Json expression(const std::string& definition, Json name) {
  Json alternatives = Json::array({std::move(name)});
  const auto add = [&](std::string_view key, Json content) {
    Json object = object_schema("");
    object.erase("description");
    object["properties"][std::string(key)] = std::move(content);
    object["required"].push_back(key);
    alternatives.push_back(std::move(object));
  };
  for (const Primitive& primitive : primitives()) {
    Json parameters = object_schema(primitive.summary);
    declare(parameters, primitive.options.options, primitive.options.old_names);
    add(primitive.name, std::move(parameters));
  }
  for (const SetOperation& operation : set_operations)
    add(operation.name, {{"type", "array"}, {"items", reference(definition)}, {"minItems", 1}});
  return {{"oneOf", std::move(alternatives)}};
}

/// Returns the schema of a surface that cuts springs.
Json cut() {
  Json alternatives = Json::array();
  for (const CutKind& kind : cut_kinds()) {
    Json parameters = object_schema(kind.summary);
    declare(parameters, kind.options.options, kind.options.old_names);
    if (kind.has_corners) {
      parameters["properties"][std::string(corners_option)] = {
          {"type", "array"},
          {"description", corners_help},
          {"items", value_schema(corner_option())},
          {"minItems", 3}};
      parameters["required"].push_back(corners_option);
    }
    Json object = object_schema(kind.summary);
    object["properties"][std::string(kind.name)] = std::move(parameters);
    object["required"].push_back(kind.name);
    alternatives.push_back(std::move(object));
  }
  return {{"oneOf", std::move(alternatives)}};
}

}  // namespace

std::string scene_schema(const std::vector<const Component*>& components) {
  std::vector<std::string> of_family[std::size(family_names)], later;
  Json definitions{{"quantity",
                    {{"type", "string"},
                     {"description", "a number with a unit, such as \"1 mm\""},
                     {"pattern", number_with_unit}}},
                   {"variable",
                    {{"type", "string"},
                     {"description", "a text with \"${name}\", a name of \"variables\""},
                     {"pattern", R"(\$\{)"}}},
                   {"region", expression("region", {{"type", "string"}})},
                   {"solid", expression("solid", {{"type", "string"},
                                                  {"not", {{"enum", built_in_region_names()}}}})}};
  for (const Component* component : components) {
    const Family family = component->info.family;
    if (family == Family::engines) continue;  // no scene names one
    definitions[component->type()] = component_schema(component->info);
    of_family[static_cast<std::size_t>(family)].push_back(component->type());
    if (family != Family::failures && family != Family::lattices)
      later.push_back(component->type());
  }
  const auto types = [&](Family family) { return of_family[static_cast<std::size_t>(family)]; };
  definitions["cut"] = cut();
  definitions["plugin_field"] = plugin_field(components);
  definitions["criterion"] = one_of(types(Family::failures));
  definitions["failure"] = {
      {"anyOf",
       {reference("criterion"),
        {{"type", "array"}, {"items", reference("criterion")}, {"minItems", 1}}}}};
  const auto holds = [&](Family family) {
    Json has{
        {"properties", {{"type", {{"pattern", fmt::format(R"(^{}\.)", family_name(family))}}}}},
        {"required", {"type"}}};
    return Json{{"contains", or_variable(std::move(has))}};
  };
  std::vector<std::string> stages = types(Family::lattices);
  stages.insert(stages.end(), later.begin(), later.end());
  // Included files may hold any stages before those of the scene.
  const Json pipeline{{"type", "array"},
                      {"description", "the lattice first, then the other stages in their order"},
                      {"items", one_of(stages)}};
  const Json whole{{"required", {"format", "pipeline"}},
                   {"properties",
                    {{"pipeline",
                      {{"prefixItems", Json::array({one_of(types(Family::lattices))})},
                       {"items", one_of(later)},
                       {"minItems", 1},
                       {"allOf", {holds(Family::materials), holds(Family::solvers)}}}}}}};
  const Json file_names{
      {"description", "files with parts of this scene, relative to it"},
      {"examples", {"rock.json"}},
      {"anyOf", {{{"type", "string"}}, {{"type", "array"}, {"items", {{"type", "string"}}}}}}};
  Json named{{"type", "object"},
             {"description", "regions by name, for the options of all stages"},
             {"propertyNames", {{"not", {{"enum", built_in_region_names()}}}}},
             {"additionalProperties", reference("region")}};
  const Json scene{
      {"$schema", "https://json-schema.org/draft/2020-12/schema"},
      {"title", "Hyperlattice scene"},
      {"type", "object"},
      {"properties",
       {{"$schema",
         {{"type", "string"}, {"description", "the place of this schema, for editors alone"}}},
        {"include", file_names},
        {"variables",
         {{"type", "object"},
          {"description", "values by name; \"${name}\" in a text stands for the value"},
          {"propertyNames", {{"pattern", "^[A-Za-z_][A-Za-z0-9_]*$"}}}}},
        {"format", {{"const", "hyperlattice/1"}, {"description", "the kind of this file"}}},
        {"title", {{"type", "string"}, {"description", "a line of text about the scene"}}},
        {"plugins",
         {{"type", "array"},
          {"description",
           "libraries, folders of libraries and source files of components, relative to the scene"},
          {"examples", {Json::array({"my_law.cpp"})}},
          {"items", {{"type", "string"}}}}},
        {"precision",
         {{"enum", precision_names},
          {"description", precision_help},
          {"default", precision_names[0]}}},
        {"interface_springs",
         {{"enum", interface_springs_names},
          {"description", interface_springs_help},
          {"default", interface_springs_names[0]}}},
        {"allow_unstable",
         {{"type", "boolean"}, {"description", allow_unstable_help}, {"default", false}}},
        {"regions", std::move(named)},
        {"pipeline", pipeline}}},
      {"if", {{"not", {{"required", {"include"}}}}}},
      {"then", whole},
      {"additionalProperties", false},
      {"$defs", std::move(definitions)}};
  return scene.dump(2);
}

}  // namespace hyperlattice
