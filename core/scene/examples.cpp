#include <scene/examples.hpp>
#include <scene/expectation.hpp>
#include <scene/units.hpp>

#include <nlohmann/json.hpp>

namespace hyperlattice {

namespace {

/// A number in the option's range, with its unit where the usual one will do.
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

}  // namespace

Json example_value(const Option& option) {
  if (!option.fallback.empty()) return Json::parse(option.fallback);
  switch (option.kind) {
    case OptionKind::number:
      return example_number(option);
    case OptionKind::integer:
      return option.low != -infinity ? static_cast<std::int64_t>(std::ceil(option.low + (option.low_open ? 0.5 : 0))) : 1;
    case OptionKind::boolean:
      return true;
    case OptionKind::text:
      return "text";
    case OptionKind::choice:
      return option.choices.front();
    case OptionKind::vector:
      return Json::array({example_number(option), example_number(option), example_number(option)});
    case OptionKind::numbers:
      return Json::array({example_number(option)});
    case OptionKind::texts:
      return option.choices.empty() ? Json::array({"text"}) : Json::array({option.choices.front()});
    case OptionKind::shape:
      return Json{{"sphere", {{"radius", "10 mm"}}}};
    case OptionKind::region:
      return "surface";
  }
  return nullptr;
}

Json example_stage(const ComponentInfo& info) {
  Json stage{{"type", info.name}};
  for (const Option& option : info.options)
    if (option.fallback.empty() && !option.optional) stage[std::string(option.name)] = example_value(option);
  return stage;
}

}  // namespace hyperlattice
