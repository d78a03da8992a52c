// Documentation of components, from their declarations alone.
#include <scene/common_options.hpp>
#include <scene/cut_reader.hpp>
#include <scene/examples.hpp>
#include <scene/expectation.hpp>
#include <scene/scene.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

constexpr std::string_view kind_names[] = {"number", "integer", "boolean", "text",
                                           "choice", "vector",  "numbers", "texts",
                                           "shape",  "region",  "file",    "load or region"};

std::string fallback_text(const Option& option) {
  if (!option.fallback.empty()) return fmt::format("`{}`", option.fallback);
  return option.optional ? "none" : "required";
}

/// Returns the valid values of the option without the unit, which has its own column.
std::string range_column(const Option& option) {
  std::string text;
  switch (option.kind) {
    case OptionKind::number:
    case OptionKind::integer:
    case OptionKind::vector:
    case OptionKind::numbers: {
      Option plain = option;
      plain.unit = "";
      text = range_text(plain);
      if (option.kind == OptionKind::number && text.empty()) text = "any number";
      if (option.kind == OptionKind::integer) text = text.empty() ? "integer" : "integer " + text;
      if (option.kind == OptionKind::vector)
        text = (option.nonzero ? "[x, y, z], not zero" : "[x, y, z]") +
               (text.empty() ? "" : ", each " + text);
      if (option.kind == OptionKind::numbers) text = text.empty() ? "list" : "list, each " + text;
      break;
    }
    case OptionKind::choice:
    case OptionKind::texts:
      for (const std::string_view choice : option.choices)
        text += fmt::format("{}`\"{}\"`", text.empty() ? "" : ", ", choice);
      if (option.plugin_fields) text += ", or a field of a material";
      if (option.kind == OptionKind::texts)
        text = text.empty() ? "list of texts" : "list of " + text;
      break;
    default:
      text = kind_names[static_cast<std::size_t>(option.kind)];
  }
  if (!option.word.empty())
    text += fmt::format("{}`\"{}\"`", text.empty() ? "" : ", or ", option.word);
  return text;
}

/// Returns the help with the former names of the option.
std::string meaning_column(const Option& option, std::span<const OldName> old_names) {
  std::string text(option.help);
  for (const OldName& old : old_names)
    if (old.option == option.name) {
      text += fmt::format("; named `{}` before version {}", old.name, old.since);
      for (const OldValue& value : old.values)
        text += fmt::format(", `{}` for `{}`", value.before, value.now);
    }
  return text;
}

/// A key of a family that is no plain option.
struct ObjectKey {
  std::string_view name, kind, range, help;
};

/// Returns those keys of a family.
std::span<const ObjectKey> object_keys(Family family) {
  static constexpr ObjectKey of_materials[] = {
      {"failure", "stage", "object, or list of objects", failure_help}};
  static constexpr ObjectKey of_lattices[] = {{cuts_key, "surfaces", "list of objects", cuts_help}};
  if (family == Family::materials) return of_materials;
  if (family == Family::lattices) return of_lattices;
  return {};
}

void table(std::string& page, std::span<const Option> options, std::span<const OldName> old_names,
           std::span<const ObjectKey> keys) {
  page += "| option | unit | range | default | meaning |\n|---|---|---|---|---|\n";
  for (const Option& option : options)
    page +=
        fmt::format("| `{}` | {} | {} | {} | {} |\n", option.name, option.unit,
                    range_column(option), fallback_text(option), meaning_column(option, old_names));
  for (const ObjectKey& key : keys)
    page += fmt::format("| `{}` | | {} | none | {} |\n", key.name, key.range, key.help);
}

void section(std::string& page, const char* title, std::string_view text) {
  if (!text.empty()) page += fmt::format("\n## {}\n\n{}\n", title, text);
}

Json option_json(const Option& option, std::span<const OldName> old_names) {
  Json json{{"name", option.name},
            {"kind", kind_names[static_cast<std::size_t>(option.kind)]},
            {"help", option.help}};
  if (!option.unit.empty()) json["unit"] = option.unit;
  if (option.low != -infinity) json[option.low_open ? "above" : "at_least"] = option.low;
  if (option.high != infinity) json[option.high_open ? "below" : "at_most"] = option.high;
  if (!option.choices.empty())
    json["choices"] = std::vector<std::string>(option.choices.begin(), option.choices.end());
  if (!option.word.empty()) json["word"] = option.word;
  if (!option.fallback.empty()) json["default"] = Json::parse(option.fallback);
  json["required"] = option.fallback.empty() && !option.optional;
  for (const OldName& old : old_names)
    if (old.option == option.name) {
      Json former{{"name", old.name}, {"since", old.since}};
      for (const OldValue& value : old.values)
        former["values"].push_back({Json::parse(value.before), Json::parse(value.now)});
      json["formerly"].push_back(std::move(former));
    }
  return json;
}

/// Returns the fields that a material declares, or those of the core that an output may name.
std::vector<const FieldInfo*> fields_of(const ComponentInfo& info) {
  std::vector<const FieldInfo*> fields;
  for (const FieldInfo& field : info.fields) fields.push_back(&field);
  for (const Option& option : info.options) {
    if (!option.plugin_fields) continue;
    for (const std::string_view choice : option.choices)
      if (const FieldInfo* field = find_field_part(choice).field;
          field != nullptr && std::find(fields.begin(), fields.end(), field) == fields.end())
        fields.push_back(field);
  }
  return fields;
}

/// Returns the names of a field's components; none of a number.
std::span<const std::string_view> components_named(const FieldInfo& field) {
  if (field.kind == FieldKind::number) return {};
  return parts_of(field.kind);
}

std::string fields_table(const ComponentInfo& info) {
  std::string rows;
  for (const FieldInfo* field : fields_of(info)) {
    std::string components;
    for (const std::string_view name : components_named(*field))
      components += fmt::format("{}`{}`", components.empty() ? "" : " ", name);
    rows +=
        fmt::format("\n| `{}` | {} | {} | {} |", field->name, components, field->unit, field->help);
  }
  if (rows.empty()) return "";
  return std::string("Outputs may name these fields") +
         (info.fields.empty() ? ", where a run has them, and those that its materials declare.\n\n"
                              : ". A particle has one number of each.\n\n") +
         "| field | components | unit | meaning |\n|---|---|---|---|" + rows;
}

Json fields_json(const ComponentInfo& info) {
  Json json = Json::array();
  for (const FieldInfo* field : fields_of(info)) {
    const auto components = components_named(*field);
    json.push_back({{"name", field->name},
                    {"unit", field->unit},
                    {"components", std::vector<std::string>(components.begin(), components.end())},
                    {"help", field->help}});
  }
  return json;
}

Json options_json(std::span<const Option> options, std::span<const OldName> old_names) {
  Json json = Json::array();
  for (const Option& option : options) json.push_back(option_json(option, old_names));
  return json;
}

/// Returns how a component is used, as a block of code.
std::string example_text(const ComponentInfo& info) {
  if (info.family == Family::engines) return "```sh\nmpirun -n 4 hyperlattice run scene.json\n```";
  const std::string stage = example_stage(info).dump();
  return fmt::format("```json\n{}\n```",
                     info.family == Family::failures ? "\"failure\": " + stage : stage);
}

}  // namespace

std::string component_page(const Component& component) {
  const ComponentInfo& info = component.info;
  const OptionSet& common = common_options(info.family);
  std::string page = fmt::format("# {}\n\n{}\n", info.name, info.summary);
  if (!info.equation.empty())
    section(page, "Equation", fmt::format("```text\n{}\n```", info.equation));
  page += "\n## Options\n\n";
  if (info.options.empty())
    page += "None of its own.\n";
  else
    table(page, info.options, info.old_names, {});
  if (!common.options.empty()) {
    page += fmt::format("\nAs every component of the family {}:\n\n", family_name(info.family));
    table(page, common.options, common.old_names, object_keys(info.family));
  }
  if (!info.options.empty() || !common.options.empty())
    page +=
        "\nNumbers are in the unit given; a text with a unit, such as \"1 mm\", is converted.\n";
  section(page, "Example", example_text(info));
  section(page, "Fields", fields_table(info));
  section(page, "Restrictions", info.restrictions);
  section(page, "Source", info.source);
  return page;
}

std::string component_json(const Component& component) {
  const ComponentInfo& info = component.info;
  const OptionSet& keys = common_options(info.family);
  Json common = options_json(keys.options, keys.old_names);
  for (const ObjectKey& key : object_keys(info.family))
    common.push_back(
        {{"name", key.name}, {"kind", key.kind}, {"help", key.help}, {"required", false}});
  return json_text(Json{{"type", info.name},
                        {"family", family_name(info.family)},
                        {"summary", info.summary},
                        {"equation", info.equation},
                        {"source", info.source},
                        {"restrictions", info.restrictions},
                        {"plugin", component.plugin},
                        {"version", component.version},
                        {"path", component.path.string()},
                        {"options", options_json(info.options, info.old_names)},
                        {"common_options", std::move(common)},
                        {"fields", fields_json(info)},
                        {"example", example_stage(info)}});
}

}  // namespace hyperlattice
