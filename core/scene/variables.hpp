// The variables of a scene: names for values, which the strings of the scene use as "${name}". A
// string that is one "${name}" stands for any JSON value; other strings are arithmetic of
// quantities (quantities/expression.hpp), or, where an option takes a text, a text with gaps.
#pragma once

#include <base/errors.hpp>
#include <quantities/dimensions.hpp>
#include <scene/json.hpp>

#include <nlohmann/json.hpp>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace hyperlattice {

/// Returns whether a text has a "${".
bool has_variable(std::string_view text);

class Variables {
 public:
  Variables() = default;
  /// Reads the object of a scene's key "variables" and adds a fault for each wrong one: a name that
  /// is no name, an unknown variable, a definition that leads back to itself, wrong arithmetic.
  Variables(const Json& given, Faults& faults);

  /// Replaces each string below `value` that is one "${name}" by the value of the variable. Adds a
  /// fault for each unknown name in any string. `pointer`: JSON pointer of `value`.
  void insert(Json& value, const std::string& pointer, Faults& faults);

  /// Returns whether a variable of the text is unknown or has a fault, which was reported.
  bool is_faulty(std::string_view text) const;
  /// Returns the value of an expression with variables.
  QuantityValue evaluate(const std::string& text) const;
  /// Returns a text with each "${name}" replaced: by the text or number that the variable is given
  /// as, or by the value of its arithmetic with the SI unit. `problem`: why there is none, or
  /// empty.
  std::string fill(const std::string& text, std::string& problem) const;

  /// Returns the names of the variables, in their order.
  const std::vector<std::string>& names() const { return names_; }
  /// Returns whether a string outside of the variables or a used variable has this one.
  bool is_used(const std::string& name) const { return used_.contains(name); }
  /// Returns the values, SI, of the variables that are numbers or quantities.
  std::map<std::string, double> numbers() const;

 private:
  QuantityValue quantity(const std::string& name) const;
  void define(const std::string& name, Faults& faults);
  void check_names(const std::string& text, const std::string& pointer, Faults& faults);
  void use(const std::string& name);
  bool can_stand(const Json& value, const std::string& pointer, Faults& faults);

  std::vector<std::string> names_;
  std::map<std::string, Json> given_;   // by name
  std::map<std::string, Json> values_;  // by name: what "${name}" stands for; only valid ones
  std::set<std::string> faulty_, used_;
  std::vector<std::string> under_way_;
  std::size_t inserted_ = 0;  ///< values that stand in place of a name so far
};

}  // namespace hyperlattice
