// Evaluates an expression for several sets of inputs at once, one in each lane of a vector. Each
// lane has the same bits as the evaluation of its set alone.
#pragma once

#include <quantities/compiled.hpp>

#include <array>
#include <cstring>
#include <span>

namespace hyperlattice {

namespace detail {
/// Returns the values of one instruction, lane by lane.
template <class Lanes>
Lanes lane_by_lane(const Instruction& one, const Lanes& a, const Lanes& b, const Lanes& c) {
  double numbers[4][sizeof(Lanes) / sizeof(double)];
  std::memcpy(numbers[0], &a, sizeof a);
  std::memcpy(numbers[1], &b, sizeof b);
  std::memcpy(numbers[2], &c, sizeof c);
  for (std::size_t lane = 0; lane < std::size(numbers[3]); ++lane)
    numbers[3][lane] = value_of(one, numbers[0][lane], numbers[1][lane], numbers[2][lane]);
  Lanes result;
  std::memcpy(&result, numbers[3], sizeof result);
  return result;
}

/// Returns power_of() in each lane. `exponent`: the instruction that gives b.
template <class Lanes>
Lanes power_in_lanes(const Instruction& one, const Instruction& exponent, const Lanes& a,
                     const Lanes& b) {
  const double constant = exponent.operation == Operation::constant ? exponent.value : 0;
  if (constant == 2) return a * a;
  return constant == 3 ? a * a * a : lane_by_lane(one, a, b, b);
}
}  // namespace detail

/// Returns the values of an expression. Lanes: a vector of doubles with + - * /, made from one
/// double for all lanes. `inputs`: in the order of the names that the expression was compiled with.
template <class Lanes>
Lanes values_of(const Compiled& expression, std::span<const Lanes> inputs) {
  std::array<Lanes, most_instructions> values;  // each is set before it is used
  const std::span<const Instruction> code = expression.code();
  std::size_t n = 0;
  for (const Instruction& one : expression.inputs()) values[n++] = inputs[one.a];
  for (const Instruction& one : expression.constants()) values[n++] = Lanes(one.value);
  for (; n < code.size(); ++n) {
    const Instruction& one = code[n];
    const Lanes &a = values[one.a], &b = values[one.b];
    switch (one.operation) {
      case Operation::constant:
        values[n] = Lanes(one.value);
        break;
      case Operation::input:
        values[n] = inputs[one.a];
        break;
      case Operation::add:
        values[n] = a + b;
        break;
      case Operation::subtract:
        values[n] = a - b;
        break;
      case Operation::multiply:
        values[n] = a * b;
        break;
      case Operation::divide:
        values[n] = a / b;
        break;
      case Operation::power:
        values[n] = detail::power_in_lanes(one, code[one.b], a, b);
        break;
      default:
        values[n] = detail::lane_by_lane(one, a, b, values[one.c]);
    }
  }
  return values[code.size() - 1];
}

}  // namespace hyperlattice
