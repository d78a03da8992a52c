#include <base/visible.hpp>
#include <host/component_check.hpp>

#include <hyperlattice/array_failure.hpp>
#include <hyperlattice/boundary.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
#include <utility>

namespace hyperlattice {
namespace {

bool is_identifier(std::string_view text) {
  const auto letter = [](char c) { return c >= 'a' && c <= 'z'; };
  return !text.empty() && letter(text.front()) &&
         std::all_of(text.begin(), text.end(),
                     [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_'; });
}

// Returns whether each function of a family's table is set.
bool whole(const LatticeFunctions& f) { return f.build; }
bool whole(const MaterialFunctions& f) { return f.constants && f.kernels && f.law; }
bool whole(const FailureFunctions& f) {
  if (f.surface.inputs || f.surface.ratios)
    return f.surface.inputs && f.surface.ratios && !f.alarm && !f.review && f.memory == 0;
  return f.alarm && f.review && f.memory <= max_failure_memory && (f.memory == 0 || f.start);
}
bool whole(const ArrayFailureFunctions& f) { return whole(f.springs) && f.breaks; }
bool whole(const LoadFunctions& f) { return f.declare && f.factor; }
bool whole(const SolverFunctions& f) { return f.plan && f.run; }
bool whole(const WriterFunctions& f) { return f.begin && f.frame && f.end; }
bool whole(const ProbeFunctions& f) { return f.begin && f.sample; }
bool whole(const EngineFunctions& f) {
  return f.join && f.exchange && f.largest && f.sum && f.spread && f.abort;
}

template <class Functions>
bool has_table(const ComponentInfo& info) {
  return info.functions && info.functions_size == sizeof(Functions) &&
         whole(*static_cast<const Functions*>(info.functions));
}

bool has_functions(const ComponentInfo& info) {
  if (!info.create_options || !info.destroy_options || !info.create || !info.destroy) return false;
  switch (info.family) {
    case Family::lattices:
      return has_table<LatticeFunctions>(info);
    case Family::materials:
      return has_table<MaterialFunctions>(info);
    case Family::failures:
      return has_table<FailureFunctions>(info) || has_table<ArrayFailureFunctions>(info);
    case Family::loads:
      return has_table<LoadFunctions>(info);
    case Family::solvers:
      return has_table<SolverFunctions>(info);
    case Family::writers:
      return has_table<WriterFunctions>(info);
    case Family::probes:
      return has_table<ProbeFunctions>(info);
    case Family::engines:
      return has_table<EngineFunctions>(info);
  }
  return false;
}

constexpr std::size_t longest_name = 200;  // bytes

bool is_text(std::string_view text) {
  return text.size() <= longest_text && (text.empty() || text.data() != nullptr);
}

/// Returns whether a text has only visible characters. This is required of texts that a scene
/// repeats or that are read as units, since they cannot be changed for display.
bool is_seen(std::string_view text) { return visible_line(text, longest_text) == text; }

std::string option_fault(const Option& option) {
  for (const std::string_view text :
       {option.unit, option.help, option.fallback, option.word, option.example})
    if (!is_text(text)) return "one of its texts is no text";
  if (!is_identifier(option.name))
    return "its name must be small letters, digits and underscores, a letter first";
  if (option.name == "type" || option.name == "name") return "a stage has that key already";
  if (option.kind > OptionKind::load_or_region || !option.set) return "it cannot be set";
  for (const std::string_view text : option.choices)
    if (!is_text(text) || !is_seen(text))
      return "one of its choices holds characters that nobody sees";
  if (!is_seen(option.unit) || !is_seen(option.word) ||
      visible(option.fallback, longest_text) != option.fallback)
    return "its unit, word or fallback holds characters that nobody sees";
  if (option.kind == OptionKind::choice && option.choices.empty()) return "it has no choices";
  if (!(option.low <= option.high)) return "its range is empty";
  for (const auto& [what, text] :
       {std::pair("example", option.example), std::pair("fallback", option.fallback)})
    if (!text.empty() && !nlohmann::json::accept(text))
      return std::string("its ") + what + ", " + std::string(text.substr(0, longest_name)) +
             ", is not JSON: a text needs quotes, as in \"1 mm\"";
  return "";
}

/// `names`: the names of the component's options and the former names before this one.
std::string old_name_fault(const OldName& old, const std::set<std::string_view>& names,
                           std::span<const Option> options) {
  if (!is_identifier(old.name))
    return "it must be small letters, digits and underscores, a letter first";
  if (old.name == "type" || old.name == "name") return "a stage has that key already";
  if (names.count(old.name) != 0) return "it is declared twice";
  if (std::none_of(options.begin(), options.end(),
                   [&](const Option& option) { return option.name == old.option; }))
    return "no option has its present name";
  if (old.since.empty() || !is_text(old.since) || !is_seen(old.since))
    return "it has no version since when it is the former one";
  for (const OldValue& value : old.values)
    for (const std::string_view text : {value.before, value.now})
      if (!is_text(text) || !nlohmann::json::accept(text)) return "one of its values is not JSON";
  return "";
}

/// `names`: the names of the component's fields before this one.
std::string field_fault(const FieldInfo& field, Family family,
                        const std::set<std::string_view>& names) {
  if (family != Family::materials) return "only the laws of materials give fields";
  if (!is_identifier(field.name))
    return "its name must be small letters, digits and underscores, a letter first";
  if (find_field_part(field.name).field != nullptr) return "the core has a field of that name";
  if (names.count(field.name) != 0) return "it is declared twice";
  for (const std::string_view text : {field.unit, field.help})
    if (!is_text(text) || !is_seen(text)) return "one of its texts is no text";
  if (field.help.empty()) return "it has no help";
  if (field.kind != FieldKind::number) return "it must be one number";
  return "";
}

}  // namespace

bool is_type_name(std::string_view text) {
  const auto dot = text.find('.');
  return dot != text.npos &&
         std::find(std::begin(family_names), std::end(family_names), text.substr(0, dot)) !=
             std::end(family_names) &&
         is_identifier(text.substr(dot + 1));
}

std::string component_fault(const ComponentInfo& info) {
  for (const std::string_view text :
       {info.name, info.summary, info.equation, info.source, info.restrictions})
    if (!is_text(text)) return "registers a component of which one of the texts is no text";
  const std::string name = std::string("'").append(info.name.substr(0, longest_name)) + "'";
  if (!is_type_name(info.name))
    return "registers the name " + name +
           ", which is not of the form <family>.<name> in small letters";
  const auto family = static_cast<std::size_t>(info.family);
  if (family >= std::size(family_names) || !info.name.starts_with(family_names[family]) ||
      info.name[family_names[family].size()] != '.')
    return "registers " + name + ", but the class is one of the family '" +
           (family < std::size(family_names) ? std::string(family_names[family]) : "unknown") + "'";
  if (!has_functions(info))
    return "registers " + name + " with a function missing: rebuild it against these headers";
  std::set<std::string_view> names;
  for (const Option& option : info.options) {
    if (option.name.size() > longest_name || !is_text(option.name))
      return "registers " + name + " with an option whose name is no text";
    std::string fault = option_fault(option);
    if (!names.insert(option.name).second) fault = "it is declared twice";
    if (!fault.empty())
      return "registers " + name + " with a bad option '" + std::string(option.name) +
             "': " + fault;
  }
  for (const OldName& old : info.old_names) {
    if (old.name.size() > longest_name || !is_text(old.name) || !is_text(old.option))
      return "registers " + name + " with a former name of an option that is no text";
    if (const std::string fault = old_name_fault(old, names, info.options); !fault.empty())
      return "registers " + name + " with a bad former name '" + std::string(old.name) +
             "' of an option: " + fault;
    names.insert(old.name);
  }
  std::set<std::string_view> fields;
  for (const FieldInfo& field : info.fields) {
    if (field.name.size() > longest_name || !is_text(field.name))
      return "registers " + name + " with a field whose name is no text";
    if (std::string fault = field_fault(field, info.family, fields); !fault.empty())
      return "registers " + name + " with a bad field '" + std::string(field.name) + "': " + fault;
    fields.insert(field.name);
  }
  return "";
}

}  // namespace hyperlattice
