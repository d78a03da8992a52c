#include <quantities/compiled.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace hyperlattice {

namespace {

/// Returns value_of(). Inlined, which a function that other libraries may replace cannot be.
inline double result_of(const Instruction& instruction, double a, double b, double c) {
  switch (instruction.operation) {
    case Operation::constant:
    case Operation::input:
      break;
    case Operation::add:
      return a + b;
    case Operation::subtract:
      return a - b;
    case Operation::multiply:
      return a * b;
    case Operation::divide:
      return a / b;
    case Operation::power:
      return power_of(a, b);
    case Operation::negate:
      return -a;
    case Operation::less:
      return a < b;
    case Operation::less_equal:
      return a <= b;
    case Operation::greater:
      return a > b;
    case Operation::greater_equal:
      return a >= b;
    case Operation::equal:
      return a == b;
    case Operation::not_equal:
      return a != b;
    case Operation::both:
      return a != 0 && b != 0;
    case Operation::either:
      return a != 0 || b != 0;
    case Operation::select:
      return a != 0 ? b : c;
    case Operation::minimum:
      return std::min(a, b);
    case Operation::maximum:
      return std::max(a, b);
    case Operation::atan2:
      return std::atan2(a, b);
    case Operation::call:
      return value_of(instruction.function, a);
  }
  return instruction.value;
}

}  // namespace

double value_of(const Instruction& instruction, double a, double b, double c) {
  return result_of(instruction, a, b, c);
}

double Compiled::operator()(std::span<const double> inputs) const {
  std::array<double, most_instructions> values;  // each is set before it is used
  for (std::size_t n = 0; n < code_.size(); ++n) {
    const Instruction& one = code_[n];
    if (one.operation == Operation::input)
      values[n] = inputs[one.a];
    else if (one.operation == Operation::constant)
      values[n] = one.value;
    else
      values[n] = result_of(one, values[one.a], values[one.b], values[one.c]);
  }
  return values[code_.size() - 1];
}

bool Compiled::uses(std::size_t input) const {
  return std::any_of(code_.begin(), code_.end(), [&](const Instruction& one) {
    return one.operation == Operation::input && one.a == input;
  });
}

}  // namespace hyperlattice
