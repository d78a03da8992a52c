// Expressions of quantities: values, units, dimensions, and the reasons of refusals.
#include <quantities/degree.hpp>
#include <quantities/expression.hpp>
#include <quantities/lanes.hpp>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>

namespace expression_test {
using namespace hyperlattice;

double value(std::string_view text) {
  const QuantityValue found = evaluate_expression(text);
  EXPECT_EQ(found.problem, "") << text;
  return found.value;
}
std::string unit(std::string_view text) { return unit_text_of(evaluate_expression(text).powers); }
std::string problem(std::string_view text) { return evaluate_expression(text).problem; }

const std::vector<ExpressionName> spring_names{
    {"strain", {}, {}}, {"elongation", {1}, {}}, {"limit", {1}, 2e-6}, {"rate", {1, 0, -1}, {}}};

Expression of_spring(std::string_view text) { return compile_expression(text, spring_names); }

/// The value for strain, elongation and rate.
double at(std::string_view text, double strain, double elongation, double rate) {
  const Expression found = of_spring(text);
  EXPECT_EQ(found.problem, "") << text;
  const double inputs[] = {strain, elongation, rate};
  return found.compiled ? (*found.compiled)(inputs) : std::nan("");
}

TEST(Expression, PrecedenceIsThatOfMathematics) {
  EXPECT_EQ(value("2 + 3 * 4 ^ 2 ^ 0.5"), 2 + 3 * std::pow(4, std::pow(2, 0.5)));
  EXPECT_EQ(value("-2 ^ 2"), -4);
  EXPECT_EQ(value("(1 - 2) - 3 - -1"), -3);
  EXPECT_EQ(value("8 / 2 / 2"), 2);
  EXPECT_EQ(value("1 < 2 ? 10 : 20"), 10);
  EXPECT_EQ(value("1 > 2 ? 10 : 2 > 3 ? 20 : 30"), 30);
  EXPECT_EQ(value("2 * pi"), 2 * std::numbers::pi);
  EXPECT_EQ(value("min(3, 1, 2) + max(3, 1, 2) + avg(1, 2, 6) + sum(1, 2, 3)"), 1 + 3 + 3 + 6);
  EXPECT_EQ(value("atan2(1, -1)"), std::atan2(1, -1));
}

TEST(Expression, UnitsStandBehindNumbers) {
  EXPECT_EQ(value("50 mm / 2"), 0.05 / 2);
  EXPECT_EQ(unit("50 mm / 2"), "m");
  EXPECT_EQ(value("6 m / 2 s"), 3);
  EXPECT_EQ(unit("6 m / 2 s"), "m s-1");
  EXPECT_EQ(unit("2500 kg/m3 * 1 mm ^ 3"), "kg");  // the unit mm^3
  EXPECT_EQ(unit("3 kg/(m s2)"), "m-1 kg s-2");
  EXPECT_EQ(value("5 mm-1 mm"), 0.005 - 0.001);
  EXPECT_EQ(value("20 %"), 0.2);
  EXPECT_EQ(unit("sqrt(4 m2)"), "m");
  EXPECT_EQ(value("sin(90 degrees)"), std::sin(value("90 degrees")));
  EXPECT_EQ(unit("(1 N/m / 1 kg) ^ 0.5"), "s-1");
  EXPECT_EQ(value("1 Pa s / 1 Pa"), 1);
  EXPECT_EQ(value("2e3 1/s * 3"), 6000);
  EXPECT_EQ(unit("2e3 1/s * 3"), "s-1");
  EXPECT_EQ(unit("5 1/m2"), "m-2");
  EXPECT_EQ(value("6 / 2 1/s"), 3);
}

TEST(Expression, DimensionsAreChecked) {
  EXPECT_EQ(problem("1 m + 1 s"), "\"+\" stands between a length and a time");
  EXPECT_EQ(problem("1 m - 2"), "\"-\" stands between a length and a number");
  EXPECT_EQ(problem("max(1 m, 2 s)"), "\"max\" stands between a length and a time");
  EXPECT_EQ(problem("exp(1 m)"), "\"exp\" takes a number, and not a length");
  EXPECT_EQ(problem("2 ^ 1 s"), "a power is a number, and not a time");
  EXPECT_EQ(problem("1 > 2 ? 1 m : 1 s"), "\":\" stands between a length and a time");
  EXPECT_EQ(value("max(1 mm, 0)"), 0.001);  // nothing is nothing in any unit
  EXPECT_EQ(of_spring("strain > 1 mm").problem, "\">\" stands between a number and a length");
  EXPECT_EQ(of_spring("elongation ^ strain > 0").problem,
            "a power of a length is a constant number");
}

TEST(Expression, ConditionsAreNoNumbers) {
  EXPECT_TRUE(of_spring("strain > 0.1 && elongation > limit || rate > 1 m/s").is_condition);
  EXPECT_FALSE(of_spring("strain * 2").is_condition);
  EXPECT_EQ(of_spring("(strain > 1) + 1").problem, "\"+\" takes numbers, and not a condition");
  EXPECT_EQ(of_spring("strain && strain > 1").problem,
            "\"&&\" joins conditions, such as \"strain > 0.1\"");
  EXPECT_EQ(problem("1 > 2"), "it is a condition, and no number");
}

TEST(Expression, InputsComeInTheirOrder) {
  EXPECT_EQ(at("elongation > limit", 0, 3e-6, 0), 1);
  EXPECT_EQ(at("elongation > limit", 0, 1e-6, 0), 0);
  EXPECT_EQ(at("strain + rate / (1 m/s)", 2, 0, 3), 5);
  EXPECT_EQ(at("strain", 7, 0, 0), 7);
  EXPECT_EQ(at("strain > 1 ? elongation : -elongation", 0, 3, 0), -3);
  const Expression found = of_spring("rate > 1 m/s");
  EXPECT_FALSE(found.compiled->uses(0));
  EXPECT_TRUE(found.compiled->uses(2));
}

TEST(Expression, RefusalsSayWhy) {
  const auto says = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_PRED2(says, of_spring("strian > 1").problem, "did you mean \"strain\"?");
  EXPECT_PRED2(says, of_spring("sqr(strain) > 1").problem, "did you mean \"sqrt\"?");
  EXPECT_PRED2(says, problem("1 MPaa"), "unknown unit \"MPaa\"");
  EXPECT_PRED2(says, problem("2 +"), "cut short");
  EXPECT_PRED2(says, problem(""), "empty");
  EXPECT_PRED2(says, problem("(2"), "parenthesis");
  EXPECT_PRED2(says, problem("2)"), "parenthesis");
  EXPECT_PRED2(says, problem("1,5"), "decimal point");
  EXPECT_PRED2(says, problem("1 2"), "operator is missing");
  EXPECT_PRED2(says, problem("a = 2"), "unknown");
  EXPECT_PRED2(says, problem("2 = 2"), "\"==\" compares");
  EXPECT_PRED2(says, problem("2 # 3"), "\"#\" is no part");
  EXPECT_PRED2(says, problem("1e999"), "too large");
  EXPECT_PRED2(says, problem("1 / 0"), "no finite number");
  EXPECT_PRED2(says, problem("operand_0"), "unknown");
  EXPECT_PRED2(says, problem("${a}"), "no variable is known");
  EXPECT_PRED2(says, problem(std::string(5000, '1')), "longer than");
  EXPECT_PRED2(says, problem("sin(1, 2)"), "takes 1 value");
  EXPECT_PRED2(says, problem("1 ? 2 : 3"), "condition");
  EXPECT_PRED2(says, problem("2 > 1 ? 3"), "do not agree");
}

/// An expression of as many operations as fit has its value, and one more is refused.
TEST(Expression, TheLongestOneFits) {
  const auto sum_of = [](std::size_t terms) {
    std::string text = "strain";
    for (std::size_t n = 1; n < terms; ++n) text += "+strain";
    return text;
  };
  // A term and its sum are an instruction each; the place of the last sum is left for the result.
  const std::size_t most = most_instructions / 2;
  EXPECT_EQ(at(sum_of(most), 0.25, 0, 0), 0.25 * static_cast<double>(most));
  EXPECT_EQ(of_spring(sum_of(most + 1)).problem, "it has too many operations");
}

/// Two numbers as a vector.
struct Pair {
  double lane[2];

  Pair() = default;
  explicit Pair(double both) : lane{both, both} {}
  Pair(double first, double second) : lane{first, second} {}
  friend Pair operator+(const Pair& a, const Pair& b) {
    return {a.lane[0] + b.lane[0], a.lane[1] + b.lane[1]};
  }
  friend Pair operator-(const Pair& a, const Pair& b) {
    return {a.lane[0] - b.lane[0], a.lane[1] - b.lane[1]};
  }
  friend Pair operator*(const Pair& a, const Pair& b) {
    return {a.lane[0] * b.lane[0], a.lane[1] * b.lane[1]};
  }
  friend Pair operator/(const Pair& a, const Pair& b) {
    return {a.lane[0] / b.lane[0], a.lane[1] / b.lane[1]};
  }
};

TEST(Expression, LanesHaveTheBitsOfOneEvaluation) {
  for (const char* text :
       {"1 - 20 * strain + 400 * strain^2 - strain^3 / 7", "strain > 0.1 ? exp(-strain) : strain",
        "strain^elongation_ratio", "max(strain, elongation / 1 m) - sqrt(abs(strain))",
        "-(strain^0.5) / 3", "2", "strain"}) {
    const std::vector<ExpressionName> names{
        {"strain", {}, {}}, {"elongation", {1}, {}}, {"elongation_ratio", {}, {}}};
    const Expression found = compile_expression(text, names);
    ASSERT_EQ(found.problem, "") << text;
    const Pair inputs[] = {{0.3, 0.07}, {1e-3, -2e-3}, {1.7, 2.0}};
    const Pair both = values_of<Pair>(*found.compiled, inputs);
    for (const std::size_t n : {0U, 1U}) {
      const double one[] = {inputs[0].lane[n], inputs[1].lane[n], inputs[2].lane[n]};
      EXPECT_EQ(both.lane[n], (*found.compiled)(one)) << text;
    }
  }
}

TEST(Expression, TheDegreeIsThatOfThePolynomial) {
  const auto degree = [](std::string_view text) {
    const bool is_variable[] = {true, true, false};
    return degree_of(*of_spring(text).compiled, is_variable).value_or(-1);
  };
  EXPECT_EQ(degree("2"), 0);
  EXPECT_EQ(degree("strain"), 1);
  EXPECT_EQ(degree("rate / 1 m/s + sqrt(rate / 1 m/s)"), 0);
  EXPECT_EQ(degree("strain * (1 - 20 * strain + 400 * strain^2)"), 3);
  EXPECT_EQ(degree("-strain^4 * elongation / 2 m - 1"), 5);
  EXPECT_EQ(degree("(strain^2)^3"), 6);
  EXPECT_EQ(degree("rate > 0 m/s ? 1 : 2"), 0);
  for (const char* text : {"1 / strain", "strain^0.5", "strain^-1", "2^strain", "exp(strain)",
                           "strain > 0 ? strain : 0", "max(strain, 0)", "abs(strain)"})
    EXPECT_EQ(degree(text), -1) << text;
}

/// The same sum in two ways: by the program, and by C++.
TEST(Expression, SumsOfProductsAgree) {
  EXPECT_TRUE(rc::check([](const std::vector<std::pair<int, int>>& pairs) {
    std::string text = "0";
    double sum = 0;
    for (const auto& [a, b] : pairs) {
      text += " + " + std::to_string(a) + " * (" + std::to_string(b) + ")";
      sum += static_cast<double>(a) * b;
    }
    if (text.size() < 3000) RC_ASSERT(evaluate_expression(text).value == sum);
  }));
}

}  // namespace expression_test
