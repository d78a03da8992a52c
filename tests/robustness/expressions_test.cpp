// Expressions of time in a scene, sound and damaged at random. Each gives one finite number at
// every time, or is refused with its pointer.
#include "support/mutations.hpp"
#include "support/scenes.hpp"

#include <base/errors.hpp>
#include <state/simulation.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

namespace expressions_test {
using namespace hyperlattice;

constexpr int quick = 300, thorough = 20'000;

std::string scene_with(const std::string& expression) {
  return R"({ "format": "hyperlattice/1", "pipeline": [
    { "type": "lattices.cubic", "spacing": 1, "shape": { "box": { "low": [0, 0, 0], "high": [2, 2, 2] } } },
    { "type": "materials.elastic", "young": 1e9, "density": 1000, "membrane": "none" },
    { "type": "loads.expression", "on": "z_max", "total": [1, 0, 0], "expression": )" +
         nlohmann::json(expression).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) +
         R"( },
    { "type": "solvers.explicit", "time_step": 1e-4, "end_time": 3e-4 } ] })";
}

/// Is the expression accepted, and does it give a number in each of three steps?
bool runs(const std::string& expression) {
  try {
    const auto plan = test::plan_of(scene_with(expression));
    Simulation simulation(*plan->model, 1);
    for (int n = 0; n < 3; ++n) simulation.step(1e-4);
    return true;
  } catch (const InputError& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("/pipeline/2"), std::string::npos)
        << expression << ": " << refusal.what();
  } catch (const RunError& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("/pipeline/2"), std::string::npos)
        << expression << ": " << refusal.what();
  }
  return false;
}

TEST(Expressions, AreOneValueOfTime) {
  for (const char* good : {"5", "t", "1.5e3 * t", "sin(2 * pi * t)", "t > 1e-4 ? 1 : 0",
                           "max(t, 1e-4)", "t >= 0 && t < 1", "-t ^ 2"})
    EXPECT_TRUE(runs(good)) << good;
  for (const char* bad :
       {"", " ", "1,5", "t,2", "(1,5)", "1;5", "t = 5", "u", "sin()", "sin(t", "1 +", "\"5\"",
        "5 N", "max()", "if(t < 1, 1, 0)", "t < 1 and 1", "t or 1", "!t", "t % 2"})
    EXPECT_FALSE(runs(bad)) << bad;
}

/// A part of an expression that the component's page lists, with its value at 2 s.
struct Part {
  const char *name, *expression;
  double value;
};
const Part operators[] = {
    {"+", "t + 1", 3},           {"-", "t - 5", -3},        {"*", "3 * t", 6},
    {"/", "t / 4", 0.5},         {"^", "2 ^ t ^ 3", 256},   {"<", "t < 2", 0},
    {"<=", "t <= 2", 1},         {">", "t > 1", 1},         {">=", "t >= 3", 0},
    {"==", "t == 2", 1},         {"!=", "t != 2", 0},       {"&&", "t > 1 && t < 3", 1},
    {"||", "t < 1 || t > 3", 0}, {"?:", "t > 1 ? 5 : 7", 5}};
const Part functions[] = {{"abs", "abs(-t)", 2},
                          {"sign", "sign(t - 5)", -1},
                          {"rint", "rint(t + 0.6)", 3},
                          {"sqrt", "sqrt(t)", std::sqrt(2)},
                          {"exp", "exp(t)", std::exp(2)},
                          {"ln", "ln(t + 1)", std::log(3)},
                          {"log", "log(t + 1)", std::log(3)},
                          {"log2", "log2(t + 1)", std::log2(3)},
                          {"log10", "log10(t + 1)", std::log10(3)},
                          {"sin", "sin(t)", std::sin(2)},
                          {"cos", "cos(t)", std::cos(2)},
                          {"tan", "tan(t)", std::tan(2)},
                          {"asin", "asin(t / 4)", std::asin(0.5)},
                          {"acos", "acos(t / 4)", std::acos(0.5)},
                          {"atan", "atan(t)", std::atan(2)},
                          {"atan2", "atan2(t, -1)", std::atan2(2, -1)},
                          {"sinh", "sinh(t)", std::sinh(2)},
                          {"cosh", "cosh(t)", std::cosh(2)},
                          {"tanh", "tanh(t)", std::tanh(2)},
                          {"asinh", "asinh(t)", std::asinh(2)},
                          {"acosh", "acosh(t + 1)", std::acosh(3)},
                          {"atanh", "atanh(t / 4)", std::atanh(0.5)},
                          {"min", "min(t, 1, 3)", 1},
                          {"max", "max(t, 1, 3)", 3},
                          {"sum", "sum(t, 1, 3)", 6},
                          {"avg", "avg(t, 1, 3)", 2}};
const Part constants[] = {{"pi", "pi", std::numbers::pi},
                          {"_pi", "_pi", std::numbers::pi},
                          {"_e", "_e", std::numbers::e}};

/// Evaluates each part, and returns the names of the parts, separated by `between`.
template <std::size_t Count>
std::string names_of(const Part (&parts)[Count], const std::string& between) {
  std::string names;
  for (const auto& [name, expression, value] : parts) {
    const auto plan = test::plan_of(scene_with("1 + (" + std::string(expression) + ")"));
    EXPECT_NEAR(plan->model->loads[0].factor(2), 1 + value, 1e-12 * (1 + std::abs(value)))
        << expression;
    names += (names.empty() ? "" : between) + name;
  }
  return names;
}

TEST(Expressions, TakeAllThatIsDocumentedAndSayAllThatTheyTake) {
  names_of(constants, "");
  const std::string told = "the operators `" + names_of(operators, " ") + "`, the functions " +
                           names_of(functions, ", ") + ", and nothing else";
  const auto plan = test::plan_of(scene_with("t"));
  const std::string source(plan->model->loads[0].stage->component->info.source);
  EXPECT_NE(source.find(told), std::string::npos) << source << "\n" << told;
}

void damaged(int usual) {
  constexpr std::string_view words = "0123456789.,+-*/^()?:<>=!&|\"' \tetpisncoxqrabm_\xC2\xB2\0";
  unsigned seed = 31;
  int count = 0;
  for (const char* good : {"exp(-t / 1e-3) * sin(2 * pi * 500 * t)",
                           "t > 4e-6 ? max(t, 1, 2) : (t < 1 || t > 5) ? 5 : abs(-t)"}) {
    test::Damage damage(seed++);
    for (int n = test::mutations(usual) / 2; n > 0; --n) count += runs(damage(good, words)) ? 1 : 0;
  }
  EXPECT_GT(count, 0);
}

TEST(Expressions, DamagedOnesAreReadOrRefused) { damaged(quick); }
TEST(LongExpressions, DamagedOnesAreReadOrRefused) { damaged(thorough); }

}  // namespace expressions_test
