#include <quantities/derivative.hpp>

#include <array>
#include <cmath>

namespace hyperlattice {

namespace {

/// A number and its change.
struct Change {
  double value = 0, slope = 0;
};

double slope_of(Function function, double x) {
  switch (function) {
    case Function::abs:
      return x < 0 ? -1 : 1;
    case Function::sqrt:
      return 0.5 / std::sqrt(x);
    case Function::exp:
      return std::exp(x);
    case Function::ln:
      return 1 / x;
    case Function::log2:
      return 1 / (x * std::log(2.0));
    case Function::log10:
      return 1 / (x * std::log(10.0));
    case Function::sin:
      return std::cos(x);
    case Function::cos:
      return -std::sin(x);
    case Function::tan:
      return 1 + std::tan(x) * std::tan(x);
    case Function::asin:
      return 1 / std::sqrt(1 - x * x);
    case Function::acos:
      return -1 / std::sqrt(1 - x * x);
    case Function::atan:
      return 1 / (1 + x * x);
    case Function::sinh:
      return std::cosh(x);
    case Function::cosh:
      return std::sinh(x);
    case Function::tanh:
      return 1 - std::tanh(x) * std::tanh(x);
    case Function::asinh:
      return 1 / std::sqrt(x * x + 1);
    case Function::acosh:
      return 1 / std::sqrt(x * x - 1);
    case Function::atanh:
      return 1 / (1 - x * x);
    default:
      return 0;  // steps
  }
}

/// Returns the slope of a power. A term whose factor does not change is left out, since it may have
/// no value: the logarithm of a negative base.
double slope_of_power(const Change& a, const Change& b) {
  double slope = 0;
  if (a.slope != 0) slope += b.value * power_of(a.value, b.value - 1) * a.slope;
  if (b.slope != 0) slope += power_of(a.value, b.value) * std::log(a.value) * b.slope;
  return slope;
}

double slope_of(const Instruction& one, const Change& a, const Change& b, const Change& c) {
  switch (one.operation) {
    case Operation::add:
      return a.slope + b.slope;
    case Operation::subtract:
      return a.slope - b.slope;
    case Operation::multiply:
      return a.slope * b.value + a.value * b.slope;
    case Operation::divide:
      return (a.slope - a.value / b.value * b.slope) / b.value;
    case Operation::power:
      return slope_of_power(a, b);
    case Operation::negate:
      return -a.slope;
    case Operation::select:
      return a.value != 0 ? b.slope : c.slope;
    case Operation::minimum:
      return b.value < a.value ? b.slope : a.slope;
    case Operation::maximum:
      return a.value < b.value ? b.slope : a.slope;
    case Operation::atan2:
      return (a.slope * b.value - a.value * b.slope) / (a.value * a.value + b.value * b.value);
    case Operation::call:
      return a.slope == 0 ? 0 : slope_of(one.function, a.value) * a.slope;
    default:
      return 0;  // conditions
  }
}

}  // namespace

double derivative(const Compiled& expression, std::span<const double> inputs,
                  std::span<const double> direction) {
  std::array<Change, most_instructions> changes;
  const std::span<const Instruction> code = expression.code();
  for (std::size_t n = 0; n < code.size(); ++n) {
    const Instruction& one = code[n];
    if (one.operation == Operation::input) {
      changes[n] = {inputs[one.a], direction[one.a]};
    } else if (one.operation == Operation::constant) {
      changes[n] = {one.value, 0};
    } else {
      const Change &a = changes[one.a], &b = changes[one.b], &c = changes[one.c];
      changes[n] = {value_of(one, a.value, b.value, c.value), slope_of(one, a, b, c)};
    }
  }
  return changes[code.size() - 1].slope;
}

}  // namespace hyperlattice
