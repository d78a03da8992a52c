#include <quantities/units.hpp>
#include <scene/examples.hpp>
#include <scene/expectation.hpp>
#include <scene/option_reader.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

/// Returns a number in the option's range, with its unit where the usual one fits.
Json example_number(const Option& option) {
  const bool bounded_below = option.low != -infinity, bounded_above = option.high != infinity;
  const std::string example = dimension_of(option.unit).example;
  if (!option.unit.empty()) {
    const Quantity usual = read_quantity(example, option.unit);
    if (usual.problem.empty() && in_range(option, usual.value)) return example;
  }
  if (bounded_below && bounded_above) return 0.5 * (option.low + option.high);
  const double number = bounded_below ? option.low + 1 : bounded_above ? option.high - 1 : 1;
  return number;
}

/// Returns options that the cross-check of a component requires in a stage although each is
/// optional: "exactly one of total and each".
std::vector<std::string> missing(const ComponentInfo& info, const Json& stage) {
  Faults faults;
  Regions regions;
  std::deque<std::string> texts;
  const Json none = Json::object();
  RegionReader region_reader(none, regions, faults, texts);
  std::vector<Option> options(info.options.begin(), info.options.end());
  // so that the file need not exist
  for (Option& option : options)
    if (option.kind == OptionKind::file) option.kind = OptionKind::text;
  OptionSet set = option_set(info, "");
  set.options = options;
  Json resolved;
  OptionReader(stage, "", {faults, region_reader, texts}).fill(set, resolved);
  std::vector<std::string> names;
  for (const Fault& fault : faults.all())
    if (fault.value.empty() && !fault.pointer.empty()) names.push_back(fault.pointer.substr(1));
  return names;
}

}  // namespace

Json example_value(const Option& option, std::size_t axis) {
  if (!option.example.empty()) return Json::parse(option.example);
  if (!option.fallback.empty()) return Json::parse(option.fallback);
  switch (option.kind) {
    case OptionKind::number:
      return example_number(option);
    case OptionKind::integer:
      return in_range(option, 1) || option.low == -infinity
                 ? 1
                 : static_cast<std::int64_t>(std::ceil(option.low + (option.low_open ? 0.5 : 0)));
    case OptionKind::boolean:
      return true;
    case OptionKind::text:
      return "text";
    case OptionKind::file:
      return std::string(option.name) + ".csv";
    case OptionKind::choice:
      return option.choices.front();
    case OptionKind::vector: {
      const Json number = example_number(option), other = in_range(option, 0) ? Json(0) : number;
      Json vector = Json::array({other, other, other});
      vector[axis % 3] = number;
      return vector;
    }
    case OptionKind::numbers:
      return Json::array({example_number(option)});
    case OptionKind::texts:
      return option.choices.empty() ? Json::array({"text"}) : Json::array({option.choices.front()});
    case OptionKind::shape:
      return Json{{"sphere", {{"radius", "10 mm"}}}};
    case OptionKind::region:
    case OptionKind::load_or_region:
      return "surface";
  }
  return nullptr;
}

Json example_stage(const ComponentInfo& info) {
  Json stage{{"type", info.name}};
  std::size_t vectors = 0;
  const auto add = [&](const Option& option) {
    stage[std::string(option.name)] = example_value(option, vectors);
    if (option.kind == OptionKind::vector) ++vectors;
  };
  for (const Option& option : info.options)
    if (!option.example.empty() || (option.fallback.empty() && !option.optional)) add(option);
  const std::vector<std::string> missed = missing(info, stage);
  for (const Option& option : info.options)
    if (std::find(missed.begin(), missed.end(), option.name) != missed.end()) add(option);
  return stage;
}

}  // namespace hyperlattice
