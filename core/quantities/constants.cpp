#include <quantities/constants.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

bool is_constant_name(std::string_view name) {
  constexpr std::string_view digits = "0123456789";
  constexpr std::string_view all =
      "0123456789_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
  return !name.empty() && name.find_first_not_of(all) == std::string_view::npos &&
         digits.find(name.front()) == std::string_view::npos;
}

std::string add_constant(const std::string& text, std::vector<ExpressionName>& names) {
  std::string expected = "\"name = quantity\", and not \"" + text + '"';
  const auto equals = text.find('=');
  if (equals == std::string::npos) return expected;
  std::string name = text.substr(0, equals);
  name.erase(0, name.find_first_not_of(' '));
  name.erase(name.find_last_not_of(' ') + 1);
  if (!is_constant_name(name)) return expected + ": a name has letters, digits and \"_\"";
  if (name == "pi" || std::any_of(names.begin(), names.end(),
                                  [&](const ExpressionName& other) { return other.name == name; }))
    return expected + ": the name is taken";
  // inputs stay in the list, so that a constant that uses one is told apart from an unknown name
  const Expression read = compile_expression(text.substr(equals + 1), names);
  if (!read.problem.empty()) return expected + ": " + read.problem;
  if (read.is_condition) return expected + ": it is a condition, and no quantity";
  for (std::size_t n = 0; n < names.size(); ++n)
    if (read.compiled->uses(n)) return expected + ": it depends on the spring";
  const std::vector<double> none(names.size(), 0.0);
  names.push_back({std::move(name), read.powers, (*read.compiled)(none)});
  return "";
}

}  // namespace

std::string add_constants(std::span<const std::string> texts, std::vector<ExpressionName>& names) {
  for (const std::string& text : texts)
    if (std::string expected = add_constant(text, names); !expected.empty()) return expected;
  return "";
}

}  // namespace hyperlattice
