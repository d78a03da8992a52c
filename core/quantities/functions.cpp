#include <quantities/functions.hpp>

#include <cmath>
#include <limits>

namespace hyperlattice {

std::span<const FunctionInfo> functions() {
  using F = Function;
  using D = FunctionDimensions;
  static constexpr FunctionInfo all[] = {
      {"abs", F::abs, D::kept, 1},        {"sign", F::sign, D::ratio, 1},
      {"rint", F::rint, D::numbers, 1},   {"sqrt", F::sqrt, D::root, 1},
      {"exp", F::exp, D::numbers, 1},     {"ln", F::ln, D::numbers, 1},
      {"log", F::ln, D::numbers, 1},      {"log2", F::log2, D::numbers, 1},
      {"log10", F::log10, D::numbers, 1}, {"sin", F::sin, D::angle, 1},
      {"cos", F::cos, D::angle, 1},       {"tan", F::tan, D::angle, 1},
      {"asin", F::asin, D::numbers, 1},   {"acos", F::acos, D::numbers, 1},
      {"atan", F::atan, D::numbers, 1},   {"sinh", F::sinh, D::numbers, 1},
      {"cosh", F::cosh, D::numbers, 1},   {"tanh", F::tanh, D::numbers, 1},
      {"asinh", F::asinh, D::numbers, 1}, {"acosh", F::acosh, D::numbers, 1},
      {"atanh", F::atanh, D::numbers, 1}, {"atan2", F::atan2, D::ratio, 2},
      {"min", F::min, D::kept, 0},        {"max", F::max, D::kept, 0},
      {"sum", F::sum, D::kept, 0},        {"avg", F::avg, D::kept, 0}};
  return all;
}

double value_of(Function function, double x) {
  switch (function) {
    case Function::abs:
      return std::abs(x);
    case Function::sign:
      return x > 0 ? 1 : x < 0 ? -1 : 0;
    case Function::rint:
      return std::rint(x);
    case Function::sqrt:
      return std::sqrt(x);
    case Function::exp:
      return std::exp(x);
    case Function::ln:
      return std::log(x);
    case Function::log2:
      return std::log2(x);
    case Function::log10:
      return std::log10(x);
    case Function::sin:
      return std::sin(x);
    case Function::cos:
      return std::cos(x);
    case Function::tan:
      return std::tan(x);
    case Function::asin:
      return std::asin(x);
    case Function::acos:
      return std::acos(x);
    case Function::atan:
      return std::atan(x);
    case Function::sinh:
      return std::sinh(x);
    case Function::cosh:
      return std::cosh(x);
    case Function::tanh:
      return std::tanh(x);
    case Function::asinh:
      return std::asinh(x);
    case Function::acosh:
      return std::acosh(x);
    case Function::atanh:
      return std::atanh(x);
    case Function::atan2:
    case Function::min:
    case Function::max:
    case Function::sum:
    case Function::avg:
      break;  // compiled to instructions of two values
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace hyperlattice
