#include <quantities/expression.hpp>
#include <quantities/units.hpp>
#include <scene/expectation.hpp>
#include <scene/variables.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace hyperlattice {

namespace {

constexpr std::string_view opening = "${";
// levels of variables within variables, which are read by recursion
constexpr std::size_t most_levels = 64;
// values in place of names: lists of names of lists grow fast
constexpr std::size_t most_inserted = 1'000'000;
constexpr std::size_t longest_filled = 1U << 20U;  // bytes of a text with variables

bool is_name(std::string_view name) {
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  return !name.empty() && is_letter(name.front()) &&
         std::all_of(name.begin(), name.end(),
                     [&](char c) { return is_letter(c) || (c >= '0' && c <= '9'); });
}

/// Returns the names in a text, in their order. A "${" without "}" gives the rest of the text.
std::vector<std::string> names_in(std::string_view text) {
  std::vector<std::string> names;
  for (std::size_t at = text.find(opening); at != std::string_view::npos;
       at = text.find(opening, at)) {
    at += opening.size();
    names.emplace_back(text.substr(at, text.find('}', at) - at));
  }
  return names;
}

/// Returns the name of a text that is nothing but one "${name}"; empty for other texts.
std::string only_name(std::string_view text) {
  if (!text.starts_with(opening) || text.find('}') != text.size() - 1) return "";
  return std::string(text.substr(opening.size(), text.size() - opening.size() - 1));
}

/// Returns the JSON value of a quantity: a number, or a text with the SI unit.
Json json_of(const QuantityValue& quantity) {
  if (is_plain_number(quantity.powers)) return quantity.value;
  return fmt::format("{} {}", quantity.value, unit_text_of(quantity.powers));
}

}  // namespace

bool has_variable(std::string_view text) { return text.find(opening) != std::string_view::npos; }

Variables::Variables(const Json& given, Faults& faults) {
  if (!given.is_object()) {
    faults.add("/variables", shown(given),
               "an object that gives names to values, such as {\"radius\": \"50 mm\"}");
    return;
  }
  for (const auto& [name, value] : given.items()) {
    if (!is_name(name))
      faults.add(member("/variables", name), shown(value),
                 "a name of letters, digits and \"_\" that does not begin with a digit");
    names_.push_back(name);
    given_.emplace(name, value);
  }
  for (const std::string& name : names_) define(name, faults);
  used_.clear();  // variables that only other variables use
}

/// Finds the value of a variable and of those that it uses.
void Variables::define(const std::string& name, Faults& faults) {
  if (values_.contains(name) || faulty_.contains(name)) return;
  const std::string pointer = member("/variables", name);
  const Json& given = given_.at(name);
  const auto wrong = [&](const std::string& expected) {
    faults.add(pointer, shown(given), expected);
    faulty_.insert(name);
  };
  const auto circle = std::find(under_way_.begin(), under_way_.end(), name);
  if (circle != under_way_.end()) {
    wrong(fmt::format("a value that does not lead back to itself ({} -> {})",
                      fmt::join(circle, under_way_.end(), " -> "), name));
    return;
  }
  if (under_way_.size() == most_levels)
    return wrong(fmt::format("at most {} levels of variables within variables", most_levels));
  under_way_.push_back(name);
  Json value = given;
  insert(value, pointer, faults);
  under_way_.pop_back();
  if (faulty_.contains(name)) return;
  if (given.is_string() && is_faulty(given.get_ref<const std::string&>())) {
    faulty_.insert(name);
    return;
  }
  if (value.is_string() && value == given && has_variable(value.get_ref<const std::string&>())) {
    const QuantityValue quantity = evaluate(value.get<std::string>());
    if (!quantity.problem.empty()) return wrong("arithmetic of quantities; " + quantity.problem);
    value = json_of(quantity);
  }
  values_.emplace(name, std::move(value));
}

void Variables::insert(Json& value, const std::string& pointer, Faults& faults) {
  if (value.is_array()) {
    for (std::size_t n = 0; n < value.size(); ++n) insert(value[n], member(pointer, n), faults);
  } else if (value.is_object()) {
    for (auto& [key, inner] : value.items()) insert(inner, member(pointer, key), faults);
  } else if (value.is_string() && has_variable(value.get_ref<const std::string&>())) {
    const std::string text = value.get<std::string>();
    check_names(text, pointer, faults);
    if (const auto found = values_.find(only_name(text));
        found != values_.end() && can_stand(found->second, pointer, faults))
      value = found->second;
  }
}

/// Returns whether a value may stand in place of a name; after too many values, adds one fault.
bool Variables::can_stand(const Json& value, const std::string& pointer, Faults& faults) {
  const auto count = [](const auto& self, const Json& of) -> std::size_t {
    std::size_t all = 1;
    if (of.is_structured())
      for (const Json& inner : of) all += self(self, inner);
    return all;
  };
  if (inserted_ > most_inserted) return false;
  inserted_ += count(count, value);
  if (inserted_ > most_inserted)
    faults.add(pointer, "", fmt::format("at most {} values from variables", most_inserted));
  return inserted_ <= most_inserted;
}

void Variables::check_names(const std::string& text, const std::string& pointer, Faults& faults) {
  for (const std::string& name : names_in(text)) {
    if (!given_.contains(name)) {
      if (faulty_.insert(name).second || under_way_.empty())
        faults.add(pointer, shown(text),
                   names_.empty()
                       ? fmt::format("a known variable; the scene has none, and no \"{}\"", name)
                       : fmt::format("a known variable; there is no \"{}\"", name) +
                             did_you_mean(name, names_));
      continue;
    }
    if (!under_way_.empty()) define(name, faults);
    use(name);
  }
}

/// Counts a variable as used, and those that it uses.
void Variables::use(const std::string& name) {
  if (!under_way_.empty()) return;
  std::vector<std::string> next{name};
  const auto visit = [&](const auto& self, const Json& value) -> void {
    if (value.is_structured())
      for (const Json& inner : value) self(self, inner);
    else if (value.is_string())
      for (std::string& other : names_in(value.get_ref<const std::string&>()))
        if (given_.contains(other)) next.push_back(std::move(other));
  };
  while (!next.empty()) {
    const std::string one = std::move(next.back());
    next.pop_back();
    if (used_.insert(one).second) visit(visit, given_.at(one));
  }
}

bool Variables::is_faulty(std::string_view text) const {
  const std::vector<std::string> names = names_in(text);
  return std::any_of(names.begin(), names.end(),
                     [&](const std::string& name) { return !values_.contains(name); });
}

QuantityValue Variables::quantity(const std::string& name) const {
  const auto found = values_.find(name);
  if (found == values_.end()) return {0, {}, fmt::format("\"{}\" has no value", name)};
  const Json& value = found->second;
  if (value.is_number()) return {value.get<double>(), {}, ""};
  if (!value.is_string())
    return {0, {}, fmt::format("\"{}\" is {}, and no quantity", name, shown(value))};
  const auto& text = value.get_ref<const std::string&>();
  QuantityValue quantity = read_any_quantity(text);
  if (!quantity.problem.empty()) quantity = evaluate_expression(text);
  if (!quantity.problem.empty())
    quantity.problem =
        fmt::format("\"{}\" is {}, and no quantity ({})", name, shown(value), quantity.problem);
  return quantity;
}

QuantityValue Variables::evaluate(const std::string& text) const {
  return evaluate_expression(text, [this](const std::string& name) { return quantity(name); });
}

std::string Variables::fill(const std::string& text, std::string& problem) const {
  std::string filled;
  std::size_t at = 0;
  for (std::size_t gap = text.find(opening); gap != std::string::npos;
       gap = text.find(opening, at)) {
    const std::size_t close = text.find('}', gap);
    const std::string name = text.substr(gap + opening.size(), close - gap - opening.size());
    const auto found = values_.find(name);
    if (close == std::string::npos || found == values_.end()) break;
    filled += text.substr(at, gap - at);
    if (found->second.is_structured() || found->second.is_null())
      problem =
          fmt::format("\"{}\" is {}, which cannot stand in a text", name, shown(found->second));
    else
      filled += found->second.is_string() ? found->second.get<std::string>() : found->second.dump();
    at = close + 1;
    if (filled.size() > longest_filled) {
      problem = fmt::format("the text is longer than {} bytes", longest_filled);
      break;
    }
  }
  return filled + text.substr(at);
}

std::map<std::string, double> Variables::numbers() const {
  std::map<std::string, double> numbers;
  for (const std::string& name : names_)
    if (const QuantityValue value = quantity(name); value.problem.empty())
      numbers.emplace(name, value.value);
  return numbers;
}

}  // namespace hyperlattice
