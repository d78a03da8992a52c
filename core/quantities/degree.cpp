#include <quantities/degree.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

namespace {

constexpr int no_polynomial = 1'000'000, most = 1000;

/// Returns the degree of a power. `exponent`: the instruction that gives it.
int degree_of_power(int base, const Instruction& exponent) {
  const double power = exponent.value;
  const bool counts = exponent.operation == Operation::constant && power >= 0 && power <= most &&
                      power == std::floor(power);
  return counts ? std::min(no_polynomial, base * static_cast<int>(power)) : no_polynomial;
}

}  // namespace

std::optional<int> degree_of(const Compiled& expression, std::span<const bool> is_variable) {
  const std::span<const Instruction> code = expression.code();
  std::vector<int> degrees(code.size());
  for (std::size_t n = 0; n < code.size(); ++n) {
    const Instruction& one = code[n];
    const int a = one.operation == Operation::input ? 0 : degrees[one.a], b = degrees[one.b],
              c = degrees[one.c];
    int& degree = degrees[n];
    switch (one.operation) {
      case Operation::constant:
        break;
      case Operation::input:
        degree = is_variable[one.a] ? 1 : 0;
        break;
      case Operation::negate:
        degree = a;
        break;
      case Operation::add:
      case Operation::subtract:
        degree = std::max(a, b);
        break;
      case Operation::multiply:
        degree = std::min(no_polynomial, a + b);
        break;
      case Operation::divide:
        degree = b == 0 ? a : no_polynomial;
        break;
      case Operation::power:
        degree = a == 0 && b == 0 ? 0 : degree_of_power(a, code[one.b]);
        break;
      case Operation::call:
        degree = a == 0 ? 0 : no_polynomial;
        break;
      default:
        degree = a == 0 && b == 0 && c == 0 ? 0 : no_polynomial;
    }
  }
  if (degrees.back() > most) return std::nullopt;
  return degrees.back();
}

}  // namespace hyperlattice
