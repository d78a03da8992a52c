// Expressions of time that a scene gives, whole and damaged at random: each is one finite number at every time, or is refused with its pointer.
#include "support/mutations.hpp"
#include "support/scenes.hpp"

#include <base/errors.hpp>
#include <state/simulation.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace {
using namespace hyperlattice;

constexpr int quick = 300, thorough = 20'000;

std::string scene_with(const std::string& expression) {
  return R"({ "format": "hyperlattice/1", "pipeline": [
    { "type": "lattices.cubic", "spacing": 1, "shape": { "box": { "low": [0, 0, 0], "high": [2, 2, 2] } } },
    { "type": "materials.elastic", "young": 1e9, "density": 1000, "membrane": "none" },
    { "type": "loads.expression", "on": "z_max", "total": [1, 0, 0], "expression": )" +
         nlohmann::json(expression).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + R"( },
    { "type": "solvers.explicit", "time_step": 1e-4, "end_time": 3e-4 } ] })";
}

/// Whether the expression was taken, and gave a number in each of three steps.
bool runs(const std::string& expression) {
  try {
    const auto plan = test::plan_of(scene_with(expression));
    Simulation simulation(*plan->model, 1);
    for (int n = 0; n < 3; ++n) simulation.step(1e-4);
    return true;
  } catch (const InputError& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("/pipeline/2"), std::string::npos) << expression << ": " << refusal.what();
  } catch (const RunError& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("/pipeline/2"), std::string::npos) << expression << ": " << refusal.what();
  }
  return false;
}

TEST(Expressions, AreOneValueOfTime) {
  for (const char* good : {"5", "t", "1.5e3 * t", "sin(2 * pi * t)", "t > 1e-4 ? 1 : 0", "max(t, 1e-4)", "t >= 0 && t < 1", "-t ^ 2"})
    EXPECT_TRUE(runs(good)) << good;
  for (const char* bad : {"", " ", "1,5", "t,2", "(1,5)", "1;5", "t = 5", "u", "sin()", "sin(t", "1 +", "\"5\"", "5 N", "max()"})
    EXPECT_FALSE(runs(bad)) << bad;
}

void damaged(int usual) {
  constexpr std::string_view words = "0123456789.,+-*/^()?:<>=!&|\"' \tetpisncoxqrabm_\xC2\xB2\0";
  unsigned seed = 31;
  int count = 0;
  for (const char* good : {"exp(-t / 1e-3) * sin(2 * pi * 500 * t)", "t > 4e-6 ? max(t, 1, 2) : if(t < 1, 5, abs(-t))"}) {
    test::Damage damage(seed++);
    for (int n = test::mutations(usual) / 2; n > 0; --n) count += runs(damage(good, words)) ? 1 : 0;
  }
  EXPECT_GT(count, 0);
}

TEST(Expressions, DamagedOnesAreReadOrRefused) { damaged(quick); }
TEST(LongExpressions, DamagedOnesAreReadOrRefused) { damaged(thorough); }

}  // namespace
