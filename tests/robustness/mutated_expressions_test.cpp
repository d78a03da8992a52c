// Expressions of quantities, damaged at random: each is compiled or refused with a reason, and the
// bounds of a compiled one contain its value.
#include "support/mutations.hpp"

#include <quantities/derivative.hpp>
#include <quantities/expression.hpp>
#include <quantities/interval.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace mutated_expressions_test {
using namespace hyperlattice;

constexpr int quick = 3000, thorough = 300'000;

const std::vector<ExpressionName> names{
    {"strain", {}, {}}, {"elongation", {1}, {}}, {"limit", {1}, 2e-6}, {"time", {0, 0, 1}, {}}};
constexpr double inputs[] = {1e-3, 1e-6, 2e-6};

/// Returns whether the text is an expression.
bool is_read(const std::string& text) {
  const Expression found = compile_expression(text, names);
  EXPECT_NE(found.compiled.has_value(), !found.problem.empty()) << text;
  if (!found.compiled) return false;
  const double value = (*found.compiled)(inputs);
  const Interval points[] = {
      {inputs[0], inputs[0]}, {inputs[1], inputs[1]}, {inputs[2], inputs[2]}};
  const Interval bound = bounds(*found.compiled, points);
  const double slack = std::isfinite(value) ? 1e-9 * std::abs(value) : 0;
  if (!std::isnan(value)) {
    EXPECT_TRUE(value >= bound.low - slack && value <= bound.high + slack) << text;
  }
  derivative(*found.compiled, inputs, inputs);
  return true;
}

void damaged(int usual) {
  constexpr std::string_view words =
      "0123456789.,+-*/^()?:<>=!&|\"' \tetpisncoxqrabmNPk%${}_\xC2\xB2\0";
  unsigned seed = 7;
  int read = 0;
  for (const char* good :
       {"strain > 1e-3 && (elongation > limit || time < 2 us * exp(-strain))",
        "elongation / 1 um > 2 ? max(strain, 0.5, 20 %) : sqrt(abs(strain)) ^ 3 - 1",
        "min(elongation, 2 kg m/s2 / (3 N/m)) * -2.5e3 1/s", "5 Pa s * time ^ -1 + 1 MPa"}) {
    EXPECT_TRUE(is_read(good)) << compile_expression(good, names).problem;
    test::Damage damage(seed++);
    for (int n = test::mutations(usual) / 4; n > 0; --n)
      read += is_read(damage(good, words)) ? 1 : 0;
  }
  EXPECT_GT(read, 0);
}

TEST(MutatedExpressions, AreReadOrRefused) { damaged(quick); }
TEST(LongMutatedExpressions, AreReadOrRefused) { damaged(thorough); }

}  // namespace mutated_expressions_test
