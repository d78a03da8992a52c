// The functions that expressions know, for numbers. The names are those of muParser's own.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>

namespace hyperlattice {

enum class Function : std::uint8_t {
  abs,
  sign,
  rint,
  sqrt,
  exp,
  ln,
  log2,
  log10,
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  sinh,
  cosh,
  tanh,
  asinh,
  acosh,
  atanh,
  atan2,
  min,
  max,
  sum,
  avg
};

/// The rule for the dimensions of a function's values and result.
enum class FunctionDimensions : std::uint8_t {
  numbers,  ///< numbers give a number
  angle,    ///< a number or an angle gives a number
  kept,     ///< values of one dimension give this dimension
  root,     ///< half the powers
  ratio     ///< values of one dimension give a number
};

struct FunctionInfo {
  std::string_view name;
  Function function;
  FunctionDimensions dimensions;
  int values;  ///< how many values it takes; 0: one or more
};

/// Returns all functions. A function may have two names.
std::span<const FunctionInfo> functions();

/// Returns the value of a function of one value.
double value_of(Function function, double x);

/// Returns x^exponent. The exponents 2 and 3 give products, which are many times faster.
inline double power_of(double x, double exponent) {
  if (exponent == 2) return x * x;
  return exponent == 3 ? x * x * x : std::pow(x, exponent);
}

}  // namespace hyperlattice
