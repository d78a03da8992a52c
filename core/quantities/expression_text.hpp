// The words of an expression, read before muParser sees it: numbers with units, names, variables
// and operators. muParser then gets nothing but names of its own, operators and parentheses.
#pragma once

#include <quantities/expression.hpp>

namespace hyperlattice {

/// A number or an input that stands in an expression.
struct Operand {
  double value = 0;
  Powers powers{};
  bool is_zero_word = false;         ///< written as a plain 0, which has any dimension
  std::optional<std::size_t> input;  ///< place among the inputs; nothing: a constant
};

/// What read_expression_text() returns.
struct ExpressionText {
  std::string plain;  ///< the expression with operand_name(n) in place of each operand
  std::vector<Operand> operands;
  std::string problem;  ///< a sentence; empty: all words are known
};

/// Returns the name that muParser knows an operand by.
std::string operand_name(std::size_t n);

ExpressionText read_expression_text(std::string_view text, std::span<const ExpressionName> names,
                                    const VariableReader& variable);

}  // namespace hyperlattice
