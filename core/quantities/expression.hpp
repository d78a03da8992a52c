// Expressions: arithmetic of quantities, such as "strain > 1e-3 && elongation > 2 um". muParser
// reads the grammar; names, numbers and units are read before it (expression_text.hpp), and
// dimensions are checked behind it.
#pragma once

#include <quantities/compiled.hpp>
#include <quantities/dimensions.hpp>

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice {

/// A name that an expression may use.
struct ExpressionName {
  std::string name;
  Powers powers{};
  /// value in SI units; nothing for an input, whose value comes with each evaluation
  std::optional<double> constant;
};

/// Returns the value of "${name}".
using VariableReader = std::function<QuantityValue(const std::string& name)>;

/// What compile_expression() returns.
struct Expression {
  std::optional<Compiled> compiled;
  Powers powers{};            ///< dimension of the result; none for a condition
  bool is_condition = false;  ///< the result is true or false
  std::string problem;        ///< why the text is no expression, as a sentence; empty: it is one
};

/// Compiles an expression. It holds numbers with or without a unit, the names, pi, parentheses, the
/// operators + - * / ^ < <= > >= == != && || ?:, the functions of functions.hpp and, with a reader,
/// "${name}". Inputs of the compiled expression are the names without a constant, in their order.
/// Quantities that are added, compared or chosen from have one dimension; a plain 0 has any.
Expression compile_expression(std::string_view text, std::span<const ExpressionName> names,
                              const VariableReader& variable = {});

/// Returns the value of an expression without inputs; a condition is a problem.
QuantityValue evaluate_expression(std::string_view text, const VariableReader& variable = {});

}  // namespace hyperlattice
