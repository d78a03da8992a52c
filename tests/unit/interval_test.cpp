// Bounds and derivatives of expressions, against values at many points.
#include <quantities/derivative.hpp>
#include <quantities/expression.hpp>
#include <quantities/interval.hpp>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

namespace interval_test {
using namespace hyperlattice;

const std::vector<ExpressionName> names{{"x", {}, {}}, {"y", {}, {}}};

Compiled compiled(std::string_view text) {
  Expression read = compile_expression(text, names);
  EXPECT_EQ(read.problem, "") << text;
  return std::move(read.compiled).value();
}

const char* const expressions[] = {"x + y",
                                   "x - 2 * y",
                                   "x * y",
                                   "x / y",
                                   "x ^ 2",
                                   "x ^ 3",
                                   "x ^ -2",
                                   "x ^ 0.5",
                                   "x ^ y",
                                   "abs(x) - y",
                                   "exp(x) * y",
                                   "sin(x + y)",
                                   "cos(x)",
                                   "tan(y)",
                                   "sqrt(x)",
                                   "ln(y)",
                                   "atan2(x, y)",
                                   "min(x, y, 1)",
                                   "max(x, -y)",
                                   "x > y ? x : y * 2",
                                   "cosh(x)",
                                   "tanh(x) / y",
                                   "asin(x)",
                                   "acos(x / 4)",
                                   "sign(x) * y",
                                   "rint(x)",
                                   "avg(x, y)",
                                   "-x",
                                   "acosh(2 + abs(x))"};
const char* const conditions[] = {
    "x > y",  "x >= y && x < 1",           "x <= 0 || y < x",        "x == y",
    "x != 0", "abs(x) > 0.5 && y * y < x", "(x > 0 ? x < 1 : y > 0)"};

TEST(Interval, ContainsTheValues) {
  for (const auto* list : {std::begin(expressions), std::begin(conditions)}) {
    const std::size_t count =
        list == std::begin(expressions) ? std::size(expressions) : std::size(conditions);
    for (std::size_t n = 0; n < count; ++n) {
      const Compiled expression = compiled(list[n]);
      EXPECT_TRUE(rc::check(list[n], [&] {
        const auto number = [] { return *rc::gen::inRange(-400, 400) / 100.0; };
        const double a = number(), b = number(), c = number(), d = number();
        const Interval box[] = {{std::min(a, b), std::max(a, b)}, {std::min(c, d), std::max(c, d)}};
        const Interval found = bounds(expression, box);
        for (int i = 0; i <= 4; ++i)
          for (int j = 0; j <= 4; ++j) {
            // round-off must not lead beyond the ends
            const auto part = [](const Interval& of, int n) {
              return std::min(of.high, of.low + n * (of.high - of.low) / 4);
            };
            const double point[] = {part(box[0], i), part(box[1], j)};
            const double value = expression(point);
            const double slack = 1e-12 * std::abs(value);
            if (std::isnan(value))
              RC_ASSERT(std::isinf(found.low) && std::isinf(found.high));
            else
              RC_ASSERT(value >= found.low - slack && value <= found.high + slack);
          }
      }));
    }
  }
}

TEST(Interval, IsExactWhereAnInputStandsOnce) {
  const Interval box[] = {{-1, 2}, {3, 5}};
  const auto is = [&](const char* text, double low, double high) {
    const Interval found = bounds(compiled(text), box);
    EXPECT_EQ(found.low, low) << text;
    EXPECT_EQ(found.high, high) << text;
  };
  is("x * y", -5, 10);
  is("x ^ 2", 0, 4);
  is("abs(x)", 0, 2);
  is("x < y", 1, 1);
  is("x > y", 0, 0);
  is("x > 0", 0, 1);
  is("1 / y", 0.2, 1 / 3.0);
}

TEST(Derivative, AgreesWithDifferences) {
  for (const char* text : expressions) {
    const Compiled expression = compiled(text);
    for (const double x : {0.3, 0.7})
      for (const double y : {0.4, 1.3}) {
        constexpr double h = 1e-6;
        const double along[] = {1, 0.5}, at[] = {x, y}, before[] = {x - h, y - h / 2},
                     behind[] = {x + h, y + h / 2};
        EXPECT_NEAR(derivative(expression, at, along),
                    (expression(behind) - expression(before)) / (2 * h), 1e-6)
            << text << " at " << x << ", " << y;
      }
  }
}

}  // namespace interval_test
