#include <quantities/interval.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hyperlattice {

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr Interval unknown{0, 1};  // of a condition

/// Returns the smallest interval of some numbers; of all numbers if one is not a number.
Interval hull(std::initializer_list<double> numbers) {
  Interval result{unbounded, -unbounded};
  for (const double number : numbers) {
    if (std::isnan(number)) return {};
    result.low = std::min(result.low, number);
    result.high = std::max(result.high, number);
  }
  return result;
}

Interval product(const Interval& a, const Interval& b) {
  return hull({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
}

Interval quotient(const Interval& a, const Interval& b) {
  if (b.low <= 0 && b.high >= 0) return {};
  return hull({a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high});
}

Interval power(const Interval& a, const Interval& b) {
  if (!b.is_point())
    return a.low > 0 ? hull({power_of(a.low, b.low), power_of(a.low, b.high),
                             power_of(a.high, b.low), power_of(a.high, b.high),
                             a.low < 1 && a.high > 1 ? 1 : power_of(a.low, b.low)})
                     : Interval{};
  const double n = b.low;
  if (a.low >= 0 && (n > 0 || a.low > 0)) return hull({power_of(a.low, n), power_of(a.high, n)});
  if (n != std::trunc(n) || n < 0) return {};
  if (std::fmod(n, 2) != 0) return hull({power_of(a.low, n), power_of(a.high, n)});
  return hull({power_of(a.low, n), power_of(a.high, n), a.high >= 0 ? 0 : power_of(a.high, n)});
}

/// Returns the interval of a comparison, 0 and 1, from what is certain.
Interval condition(bool certain, bool impossible) {
  if (certain) return {1, 1};
  return impossible ? Interval{0, 0} : unknown;
}

Interval of_function(Function function, const Interval& a) {
  const double low = value_of(function, a.low), high = value_of(function, a.high);
  switch (function) {
    case Function::abs:
    case Function::cosh: {
      const Interval ends = hull({low, high});
      return a.low <= 0 && a.high >= 0 ? Interval{value_of(function, 0), ends.high} : ends;
    }
    case Function::sin:
    case Function::cos:
      return a.is_point() ? hull({low, high}) : Interval{-1, 1};
    case Function::tan:
      return a.is_point() ? hull({low, high}) : Interval{};
    default:
      return hull({low, high});  // monotone; outside of its domain an end is not a number
  }
}

Interval of_operation(const Instruction& one, const Interval& a, const Interval& b,
                      const Interval& c) {
  switch (one.operation) {
    case Operation::constant:
    case Operation::input:
      break;
    case Operation::add:
      return hull({a.low + b.low, a.high + b.high});
    case Operation::subtract:
      return hull({a.low - b.high, a.high - b.low});
    case Operation::multiply:
      return product(a, b);
    case Operation::divide:
      return quotient(a, b);
    case Operation::power:
      return power(a, b);
    case Operation::negate:
      return {-a.high, -a.low};
    case Operation::less:
      return condition(a.high < b.low, a.low >= b.high);
    case Operation::less_equal:
      return condition(a.high <= b.low, a.low > b.high);
    case Operation::greater:
      return condition(a.low > b.high, a.high <= b.low);
    case Operation::greater_equal:
      return condition(a.low >= b.high, a.high < b.low);
    case Operation::equal:
      return condition(a.is_point() && b.is_point() && a.low == b.low,
                       a.high < b.low || a.low > b.high);
    case Operation::not_equal:
      return condition(a.high < b.low || a.low > b.high,
                       a.is_point() && b.is_point() && a.low == b.low);
    case Operation::both:
      return {std::min(a.low, b.low), std::min(a.high, b.high)};
    case Operation::either:
      return {std::max(a.low, b.low), std::max(a.high, b.high)};
    case Operation::select:
      if (a.low == 1) return b;
      if (a.high == 0) return c;
      return hull({b.low, b.high, c.low, c.high});
    case Operation::minimum:
      return {std::min(a.low, b.low), std::min(a.high, b.high)};
    case Operation::maximum:
      return {std::max(a.low, b.low), std::max(a.high, b.high)};
    case Operation::atan2:
      return {-std::numbers::pi, std::numbers::pi};
    case Operation::call:
      return of_function(one.function, a);
  }
  return {one.value, one.value};
}

}  // namespace

Interval bounds(const Compiled& expression, std::span<const Interval> inputs) {
  std::array<Interval, most_instructions> values;
  const std::span<const Instruction> code = expression.code();
  for (std::size_t n = 0; n < code.size(); ++n) {
    const Instruction& one = code[n];
    values[n] = one.operation == Operation::input
                    ? inputs[one.a]
                    : of_operation(one, values[one.a], values[one.b], values[one.c]);
  }
  return values[code.size() - 1];
}

}  // namespace hyperlattice
