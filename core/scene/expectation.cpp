#include <base/errors.hpp>
#include <quantities/units.hpp>
#include <scene/expectation.hpp>

#include <spdlog/fmt/fmt.h>

namespace hyperlattice {

namespace {

std::string quantity(const Option& option) {
  const Dimension dimension = dimension_of(option.unit);
  const std::string range = range_text(option);
  std::string text = option.kind == OptionKind::integer ? "an integer" : dimension.name;
  if (!range.empty()) text += ' ' + range;
  if (!option.unit.empty()) text += fmt::format(" such as \"{}\"", dimension.example);
  return text;
}

std::string names(const Option& option) {
  std::string text;
  for (const std::string_view choice : option.choices)
    text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", choice);
  if (option.plugin_fields) text += ", or a field that a material of the scene declares";
  return text;
}

std::string value_expectation(const Option& option) {
  switch (option.kind) {
    case OptionKind::boolean:
      return "true or false";
    case OptionKind::text:
      return "a text";
    case OptionKind::file:
      return "the name of a file, relative to the scene's folder";
    case OptionKind::choice:
      return "one of " + names(option);
    case OptionKind::vector:
      return "a list [x, y, z] of three, each " + entry_expectation(option);
    case OptionKind::numbers:
    case OptionKind::texts:
      return "a list, each entry " + entry_expectation(option);
    case OptionKind::shape:
      return "a solid such as {\"sphere\": {\"radius\": \"1 mm\"}}";
    case OptionKind::region:
      return "a region such as \"surface\" or {\"sphere\": {\"radius\": \"1 mm\"}}";
    case OptionKind::load_or_region:
      return "the name of a load, or a region such as \"surface\" or {\"sphere\": {\"radius\": \"1 "
             "mm\"}}";
    case OptionKind::number:
    case OptionKind::integer:
      break;
  }
  return quantity(option);
}

}  // namespace

std::string range_text(const Option& option) {
  const std::string unit = option.unit.empty() ? "" : fmt::format(" {}", option.unit);
  const bool bounded_below = option.low != -infinity, bounded_above = option.high != infinity;
  if (bounded_below && bounded_above && !option.low_open && !option.high_open)
    return fmt::format("from {} to {}{}", option.low, option.high, unit);
  std::string text;
  if (bounded_below)
    text = fmt::format("{} {}{}", option.low_open ? "above" : "of at least", option.low, unit);
  if (bounded_above)
    text += fmt::format("{}{} {}{}", text.empty() ? "" : " and ",
                        option.high_open ? "below" : "at most", option.high, unit);
  return text;
}

bool in_range(const Option& option, double value) {
  return (option.low_open ? value > option.low : value >= option.low) &&
         (option.high_open ? value < option.high : value <= option.high);
}

std::string expectation(const Option& option) {
  const std::string text = value_expectation(option);
  return option.word.empty() ? text : fmt::format("{}, or \"{}\"", text, option.word);
}

std::string entry_expectation(const Option& option) {
  if (option.kind == OptionKind::texts)
    return option.choices.empty() ? "a text" : "one of " + names(option);
  return quantity(option);
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string near = nearest(name, candidates);
  return near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near);
}

}  // namespace hyperlattice
