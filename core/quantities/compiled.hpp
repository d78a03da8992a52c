// An expression in a compact form that any number of threads may evaluate: a list of instructions,
// each of which makes one number from numbers before it. Conditions are 1 or 0.
#pragma once

#include <quantities/functions.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace hyperlattice {

enum class Operation : std::uint8_t {
  constant,  ///< Instruction::value
  input,     ///< the input number `a`
  add,
  subtract,
  multiply,
  divide,
  power,
  negate,
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  not_equal,
  both,
  either,
  select,  ///< b if a is true, otherwise c
  minimum,
  maximum,
  atan2,
  call  ///< Instruction::function of a
};

struct Instruction {
  Operation operation = Operation::constant;
  Function function = Function::abs;
  std::uint16_t a = 0, b = 0, c = 0;  ///< places of earlier instructions, or of an input
  double value = 0;
};

/// The most instructions of an expression.
inline constexpr std::size_t most_instructions = 500;

/// Returns the value of one instruction for numbers. `a`, `b`, `c`: the values that it takes.
double value_of(const Instruction& instruction, double a, double b, double c);

class Compiled {
 public:
  /// `code`: 1 to most_instructions instructions; the last one gives the result. They get another
  /// order: inputs first, each once, then constants, then the others in their order.
  explicit Compiled(const std::vector<Instruction>& code);

  std::span<const Instruction> code() const { return code_; }
  /// Returns the inputs that the expression uses, and its constants, which follow them. An
  /// expression that is nothing but an input or a constant has it as its result alone.
  std::span<const Instruction> inputs() const { return code().first(inputs_); }
  std::span<const Instruction> constants() const { return code().subspan(inputs_, constants_); }
  /// Returns the value for these inputs, in the order of the names that were compiled with. It is
  /// not a number where the expression has no value.
  double operator()(std::span<const double> inputs) const;
  /// Returns whether the result depends on an input.
  bool uses(std::size_t input) const;

 private:
  std::vector<Instruction> code_;
  std::size_t inputs_ = 0, constants_ = 0;
};

}  // namespace hyperlattice
