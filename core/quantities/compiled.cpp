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

Compiled::Compiled(const std::vector<Instruction>& code) {
  std::vector<std::uint16_t> place(code.size());  // of each instruction in the new order
  const auto add = [&](std::size_t n) {
    Instruction one = code[n];
    if (one.operation != Operation::input)
      for (std::uint16_t* operand : {&one.a, &one.b, &one.c}) *operand = place[*operand];
    place[n] = static_cast<std::uint16_t>(code_.size());
    code_.push_back(one);
  };
  const std::size_t last = code.size() - 1;
  for (std::size_t n = 0; n < last; ++n) {
    if (code[n].operation != Operation::input) continue;
    const auto same = std::find_if(code_.begin(), code_.end(),
                                   [&](const Instruction& other) { return other.a == code[n].a; });
    if (same == code_.end())
      add(n);
    else
      place[n] = static_cast<std::uint16_t>(same - code_.begin());
  }
  inputs_ = code_.size();
  for (std::size_t n = 0; n < last; ++n)
    if (code[n].operation == Operation::constant) add(n);
  constants_ = code_.size() - inputs_;
  for (std::size_t n = 0; n <= last; ++n)
    if (n == last ||
        (code[n].operation != Operation::input && code[n].operation != Operation::constant))
      add(n);
}

double Compiled::operator()(std::span<const double> inputs) const {
  std::array<double, most_instructions> values;  // each is set before it is used
  std::size_t n = 0;
  for (const Instruction& one : this->inputs()) values[n++] = inputs[one.a];
  for (const Instruction& one : constants()) values[n++] = one.value;
  for (; n < code_.size(); ++n) {
    const Instruction& one = code_[n];
    values[n] = one.operation == Operation::input
                    ? inputs[one.a]
                    : result_of(one, values[one.a], values[one.b], values[one.c]);
  }
  return values[code_.size() - 1];
}

bool Compiled::uses(std::size_t input) const {
  return std::any_of(code_.begin(), code_.end(), [&](const Instruction& one) {
    return one.operation == Operation::input && one.a == input;
  });
}

}  // namespace hyperlattice
