#include <scene/common_options.hpp>
#include <scene/cut_reader.hpp>
#include <scene/expectation.hpp>
#include <scene/stage_reader.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace hyperlattice {

namespace {

constexpr std::size_t most_stages = 10'000;

/// The families of a scene. Engines are not among them: the launcher decides about them.
const std::vector<std::string> all_families = [] {
  std::vector<std::string> names(std::begin(family_names), std::end(family_names));
  std::erase(names, family_name(Family::engines));
  return names;
}();

void take_common(const CommonOptions& common, Stage& stage) {
  stage.name = common.name.value_or("");
  stage.region = common.region;
  stage.cadence = {common.every, common.first, common.last};
  stage.record_every = common.record_every.value_or(0);
  stage.energy_tolerance = common.energy_tolerance;
  stage.approach_limit = common.approach_limit;
  stage.growth_limit = common.growth_limit;
  stage.momentum_tolerance = common.momentum_tolerance;
  stage.mass_scaling = common.mass_scaling.value_or(0);
}

/// Returns the first name of a component's option, present or former, that is a key of the core,
/// since the two could not be told apart; empty if there is none.
std::string taken_key(const ComponentInfo& info) {
  const auto names = [](std::span<const Option> options, std::span<const OldName> old_names) {
    std::vector<std::string_view> names;
    for (const Option& option : options) names.push_back(option.name);
    for (const OldName& old : old_names) names.push_back(old.name);
    return names;
  };
  const OptionSet& common = common_options(info.family);
  std::vector<std::string_view> keys = names(common.options, common.old_names);
  keys.push_back("type");
  if (info.family == Family::materials) keys.push_back("failure");
  if (info.family == Family::lattices) keys.push_back(cuts_key);
  for (const std::string_view name : names(info.options, info.old_names))
    if (std::find(keys.begin(), keys.end(), name) != keys.end()) return std::string(name);
  return "";
}

/// The type of a stage and its label.
struct Label {
  std::string type, name;
};

/// Gives each stage without a label the last part of its type, with a number if the label is taken
/// in its family.
void complete(std::vector<Label>& labels) {
  std::map<Family, std::set<std::string>> taken;
  std::map<std::string, int> last_number;  // last number used, by type
  for (const Label& label : labels)
    if (!label.name.empty()) taken[*family_of(label.type)].insert(label.name);
  for (Label& label : labels) {
    if (!label.name.empty()) continue;
    const std::string last_part = label.type.substr(label.type.rfind('.') + 1);
    label.name = last_part;
    for (int& number = last_number[label.type];
         !taken[*family_of(label.type)].insert(label.name).second;)
      label.name = fmt::format("{}_{}", last_part, number = std::max(number, 1) + 1);
  }
}

/// Returns the types and labels of the loads of a pipeline; "" where the scene has no label.
std::vector<Label> given_labels_of_loads(const Json& pipeline) {
  std::vector<Label> labels;
  for (const Json& stage : pipeline)
    if (const std::string type = word_in(stage, "type"); family_of(type) == Family::loads)
      labels.push_back({type, word_in(stage, "name")});
  return labels;
}

/// Returns the labels that the loads will have. Options of other stages name them.
std::vector<std::string> complete_labels(std::vector<Label> labels) {
  complete(labels);
  std::vector<std::string> names;
  names.reserve(labels.size());
  for (Label& label : labels) names.push_back(std::move(label.name));
  return names;
}

/// Returns the completed labels that belong to the first of several loads of one type without a
/// label of their own: a reader of the scene cannot tell which load they mean.
std::vector<std::string> ambiguous_labels(std::span<const Label> given,
                                          std::span<const std::string> completed) {
  std::map<std::string, std::vector<std::string>> unnamed;  // by type
  for (std::size_t n = 0; n < given.size(); ++n)
    if (given[n].name.empty()) unnamed[given[n].type].push_back(completed[n]);
  std::vector<std::string> ambiguous;
  for (const auto& [type, names] : unnamed)
    if (names.size() > 1) ambiguous.push_back(names.front());
  return ambiguous;
}

}  // namespace

StageReader::StageReader(Reading reading, Catalogue& catalogue, std::vector<Fault>& refusals)
    : reading_(reading), catalogue_(catalogue), refusals_(refusals) {}

Json StageReader::read(const Json& scene, std::vector<Stage>& stages) {
  Json resolved = Json::array();
  const auto pipeline = scene.find("pipeline");
  if (pipeline == scene.end() || !pipeline->is_array() || pipeline->empty()) {
    reading_.faults.add("/pipeline", pipeline == scene.end() ? "" : shown(*pipeline),
                        "a list of stages: a lattice, materials, loads, solvers, writers, probes");
    return resolved;
  }
  if (pipeline->size() > most_stages) {
    reading_.faults.add(
        "/pipeline", "",
        fmt::format("at most {} stages; there are {}", most_stages, pipeline->size()));
    return resolved;
  }
  const std::vector<Label> given = given_labels_of_loads(*pipeline);
  loads_ = complete_labels(given);
  ambiguous_loads_ = ambiguous_labels(given, loads_);
  reading_.loads = loads_;
  reading_.ambiguous_loads = ambiguous_loads_;
  find_fields(*pipeline);
  reading_.fields = fields_;
  std::vector<std::optional<Family>> families;
  for (std::size_t n = 0; n < pipeline->size(); ++n) {
    const Json& given = (*pipeline)[n];
    const std::string pointer = member("/pipeline", n);
    Json stage_resolved;
    families.push_back(read_family(given, pointer));
    if (families.back())
      if (auto stage = read_stage(given, pointer, stage_resolved)) {
        stages.push_back(std::move(*stage));
        resolved.push_back(std::move(stage_resolved));
      }
  }
  check_order(families);
  if (stages.size() == pipeline->size()) give_names(stages, resolved);
  return resolved;
}

/// Finds the fields that the pipeline's materials declare. A name has one meaning.
void StageReader::find_fields(const Json& pipeline) {
  std::vector<std::pair<const ComponentInfo*, const FieldInfo*>> found;
  for (std::size_t n = 0; n < pipeline.size(); ++n) {
    const std::string type = word_in(pipeline[n], "type");
    if (family_of(type) != Family::materials) continue;
    const Component* component = catalogue_.find(type);
    if (component == nullptr) continue;  // read_stage() says why
    for (const FieldInfo& field : component->info.fields) {
      const auto other = std::find_if(found.begin(), found.end(), [&](const auto& earlier) {
        return earlier.second->name == field.name;
      });
      if (other == found.end()) {
        found.emplace_back(&component->info, &field);
        fields_.push_back(field.name);
      } else if (other->second->unit != field.unit || other->second->help != field.help) {
        reading_.faults.add(
            member(member("/pipeline", n), "type"), shown(pipeline[n]["type"]),
            fmt::format("a material whose field \"{}\" means the same as that of {}, \"{}\"",
                        field.name, other->first->name, other->second->help));
      }
    }
  }
}

/// Returns the family of a stage's type; nothing after a fault.
std::optional<Family> StageReader::read_family(const Json& given, const std::string& pointer) {
  if (!given.is_object()) {
    reading_.faults.add(pointer, shown(given), "an object with a type");
    return std::nullopt;
  }
  const auto type = given.find("type");
  if (type == given.end() || !type->is_string()) {
    reading_.faults.add(member(pointer, "type"), type == given.end() ? "" : shown(*type),
                        "the type of a component: \"<family>.<name>\"");
    return std::nullopt;
  }
  const std::string text = type->get<std::string>();
  if (const auto family = family_of(text); family && *family != Family::engines) return family;
  const std::string prefix = text.substr(0, text.find('.'));
  reading_.faults.add(member(pointer, "type"), shown(*type),
                      "a type of one of the families " +
                          fmt::format("{}", fmt::join(all_families, ", ")) +
                          did_you_mean(prefix, all_families));
  return std::nullopt;
}

const Component* StageReader::find(const Json& given, const std::string& pointer, Family family) {
  const std::string type = given["type"].get<std::string>(), at = member(pointer, "type");
  const Component* component = catalogue_.find(type);
  if (component == nullptr && catalogue_.refused(type)) {
    refusals_.push_back({at, shown(given["type"]), catalogue_.why_not(type)});
  } else if (component == nullptr) {
    std::vector<std::string> candidates;
    for (const std::string& known : catalogue_.known_types())
      if (family_of(known) == family) candidates.push_back(known);
    const std::string near = did_you_mean(type, candidates);
    std::string all;
    if (near.empty() && !candidates.empty())
      all = fmt::format("; there {} {}", candidates.size() == 1 ? "is" : "are",
                        fmt::join(candidates, ", "));
    reading_.faults.add(at, shown(given["type"]),
                        fmt::format("a known type ({}){}{}", catalogue_.why_not(type), near, all));
  } else if (const std::string key = taken_key(component->info); !key.empty()) {
    refusals_.push_back(
        {at, shown(given["type"]),
         fmt::format("{} declares the option \"{}\", a key of the core's own", type, key)});
    return nullptr;
  }
  return component;
}

std::optional<Stage> StageReader::read_stage(const Json& given, const std::string& pointer,
                                             Json& resolved) {
  const Family family = *family_of(given["type"].get<std::string>());
  if (family == Family::failures) {
    reading_.faults.add(member(pointer, "type"), shown(given["type"]),
                        "a failure criterion inside its material, as its \"failure\"");
    return std::nullopt;
  }
  Stage stage;
  stage.pointer = pointer;
  resolved = {{"type", given["type"]}, {"name", ""}};
  const auto failure = family == Family::materials ? given.find("failure") : given.end();
  // read first, so that its faults are found also if the material is unknown
  Json failure_resolved;
  std::optional<std::vector<Stage>> failures;
  if (failure != given.end())
    failures = read_failures(*failure, member(pointer, "failure"), failure_resolved);
  const auto cut = family == Family::lattices ? given.find(cuts_key) : given.end();
  Json cuts_resolved;
  std::optional<std::vector<Cut>> cuts;
  if (cut != given.end())
    cuts = read_cuts(*cut, member(pointer, std::string(cuts_key)), reading_, cuts_resolved);
  stage.component = find(given, pointer, family);
  if (stage.component == nullptr) return std::nullopt;

  std::vector<std::string> keys{"type"};
  if (family == Family::materials) keys.emplace_back("failure");
  if (family == Family::lattices) keys.emplace_back(cuts_key);
  OptionReader reader(given, pointer, reading_, std::move(keys));
  const OptionsPointer common = reader.fill(common_options(family), resolved);
  stage.options =
      reader.fill(option_set(stage.component->info, stage.component->path.c_str()), resolved);
  reader.reject_unknown();
  if (!common || !stage.options || (failure != given.end() && !failures) ||
      (cut != given.end() && !cuts))
    return std::nullopt;
  if (failures) {
    stage.failures = std::move(*failures);
    resolved["failure"] = std::move(failure_resolved);
  }
  if (cuts) {
    stage.cuts = std::move(*cuts);
    resolved[std::string(cuts_key)] = std::move(cuts_resolved);
  }
  take_common(*static_cast<const CommonOptions*>(common.get()), stage);
  return stage;
}

/// Reads one criterion or a list of them; nothing after a fault.
std::optional<std::vector<Stage>> StageReader::read_failures(const Json& given,
                                                             const std::string& pointer,
                                                             Json& resolved) {
  std::vector<Stage> failures;
  if (!given.is_array()) {
    auto failure = read_failure(given, pointer, resolved);
    if (!failure) return std::nullopt;
    failures.push_back(std::move(*failure));
    return failures;
  }
  if (given.empty())
    reading_.faults.add(pointer, shown(given),
                        "at least one criterion; without the key springs do not break");
  resolved = Json::array();
  for (std::size_t n = 0; n < given.size(); ++n) {
    Json failure_resolved;
    auto failure = read_failure(given[n], member(pointer, n), failure_resolved);
    if (!failure) continue;
    failures.push_back(std::move(*failure));
    resolved.push_back(std::move(failure_resolved));
  }
  if (given.empty() || failures.size() < given.size()) return std::nullopt;
  return failures;
}

std::optional<Stage> StageReader::read_failure(const Json& given, const std::string& pointer,
                                               Json& resolved) {
  const auto family = read_family(given, pointer);
  if (!family) return std::nullopt;
  if (*family != Family::failures) {
    reading_.faults.add(member(pointer, "type"), shown(given["type"]),
                        "a type of the family failures");
    return std::nullopt;
  }
  Stage stage;
  stage.component = find(given, pointer, Family::failures);
  if (stage.component == nullptr) return std::nullopt;
  stage.pointer = pointer;
  const std::string type = stage.component->type();
  stage.name = type.substr(type.rfind('.') + 1);
  resolved = {{"type", given["type"]}};
  OptionReader reader(given, pointer, reading_, {"type"});
  stage.options =
      reader.fill(option_set(stage.component->info, stage.component->path.c_str()), resolved);
  reader.reject_unknown();
  if (!stage.options) return std::nullopt;
  return stage;
}

void StageReader::check_order(const std::vector<std::optional<Family>>& families) {
  const bool all_known = std::all_of(families.begin(), families.end(),
                                     [](const auto& family) { return family.has_value(); });
  const auto count = [&](Family family) {
    return std::count(families.begin(), families.end(), family);
  };
  bool lattice_seen = families.front() == Family::lattices;
  for (std::size_t n = 1; n < families.size(); ++n)
    if (families[n] == Family::lattices) {
      reading_.faults.add(
          member("/pipeline", n), "",
          lattice_seen ? "no second lattice" : "the lattice as the first stage of the pipeline");
      lattice_seen = true;
    }
  if (!all_known) return;  // a stage that could not be read may be the missing one
  if (!lattice_seen)
    reading_.faults.add("/pipeline/0", "", "a lattice as the first stage of the pipeline");
  if (count(Family::materials) == 0) reading_.faults.add("/pipeline", "", "at least one material");
  if (count(Family::solvers) == 0) reading_.faults.add("/pipeline", "", "at least one solver");
}

void StageReader::give_names(std::vector<Stage>& stages, Json& resolved) {
  std::map<Family, std::set<std::string>> taken;
  std::vector<Label> labels;
  for (const Stage& stage : stages) {
    labels.push_back({stage.component->type(), stage.name});
    if (!stage.name.empty() && !taken[stage.family()].insert(stage.name).second)
      reading_.faults.add(
          member(stage.pointer, "name"), shown(stage.name),
          fmt::format("a label of its own among the {}", family_name(stage.family())));
  }
  complete(labels);
  for (std::size_t n = 0; n < stages.size(); ++n)
    resolved[n]["name"] = stages[n].name = std::move(labels[n].name);
}

}  // namespace hyperlattice
