// The plan against what is then really built: bytes to the last one, steps, and what the kernel carries for each choice in a scene.
#include "support/program.hpp"

#include <plan/plan.hpp>
#include <run/state.hpp>

#include <gtest/gtest.h>

#include <algorithm>

using namespace hyperlattice;
using test::small_sphere;

namespace {

std::unique_ptr<Plan> plan_of(const nlohmann::json& scene, int threads = 1) {
  const test::Folder folder("plan");
  setenv("HYPERLATTICE_PLUGIN_PATH", HYPERLATTICE_BUILD "/lib/hyperlattice", 1);
  static Host host;
  return make_plan(read_scene(test::write_scene(folder, scene), {}, host), threads);
}

bool leaves_out(const Plan& plan, const std::string& what) {
  return std::any_of(plan.left_out.begin(), plan.left_out.end(), [&](const LeftOut& left) { return left.what == what; });
}

TEST(Plan, bytes_are_those_of_the_state) {
  for (const char* membrane : {"none", "I-m", "III"})
    for (const int threads : {1, 2, 5}) {
      auto scene = small_sphere();
      scene["pipeline"][1]["membrane"] = membrane;
      scene["pipeline"][1]["poisson"] = std::string(membrane) == "none" ? 0.25 : std::string(membrane) == "III" ? 0.2 : 0.1;
      const auto plan = plan_of(scene, threads);
      const Simulation simulation(*plan->model, threads);
      const auto particles = static_cast<double>(plan->model->body.particles);
      EXPECT_EQ(plan->bytes_per_particle * particles, simulation.bytes()) << membrane;
      EXPECT_GT(plan->memory_bytes, simulation.bytes() + simulation.scratch_bytes());
      EXPECT_GE(plan->bytes_per_particle, 2 * 8 * plan->model->degrees_of_freedom + 2);
    }
}

TEST(Plan, carries_only_what_the_scene_needs) {
  auto scene = small_sphere();
  const auto plain = plan_of(scene);
  EXPECT_EQ(plain->model->degrees_of_freedom, 4);
  EXPECT_TRUE(leaves_out(*plain, "failure"));
  EXPECT_TRUE(leaves_out(*plain, "local damping"));
  EXPECT_FALSE(leaves_out(*plain, "fourth dimension"));

  scene["pipeline"][1]["membrane"] = "none";
  scene["pipeline"][1].erase("poisson");
  scene["pipeline"][1]["failure"] = {{"type", "failures.elongation"}, {"limit", "3.5e-3 mm"}};
  scene["pipeline"][3]["damping"] = 0.5;
  const auto flat = plan_of(scene);
  EXPECT_EQ(flat->model->degrees_of_freedom, 3);
  EXPECT_TRUE(leaves_out(*flat, "fourth dimension"));
  EXPECT_FALSE(leaves_out(*flat, "failure"));
  EXPECT_FALSE(leaves_out(*flat, "local damping"));
  EXPECT_LT(flat->bytes_per_particle, plain->bytes_per_particle);
}

TEST(Plan, fields_that_nobody_asks_for_are_left_out) {
  auto scene = small_sphere();
  scene["pipeline"].push_back({{"type", "writers.vtu"}, {"fields", {"displacement", "height"}}});
  const auto plan = plan_of(scene);
  EXPECT_TRUE(leaves_out(*plan, "field velocity"));
  EXPECT_TRUE(leaves_out(*plan, "field damage"));
  EXPECT_FALSE(leaves_out(*plan, "field displacement"));
  EXPECT_FALSE(leaves_out(*plan, "field height"));
}

TEST(Plan, steps_are_safe_and_land_on_the_end) {
  auto scene = small_sphere();
  scene["pipeline"][3]["damping"] = 0.8;
  const auto plan = plan_of(scene);
  const SolverPlan& solver = plan->stages.at(0).plan;
  EXPECT_NEAR(solver.stable_time_step, plan->model->critical_time_step / std::sqrt(1.8), 1e-9 * solver.stable_time_step);
  EXPECT_LE(solver.time_step, 0.9 * solver.stable_time_step * (1 + 1e-12));
  EXPECT_GE(static_cast<double>(solver.steps) * solver.time_step, 10e-6 * (1 - 1e-9));
  EXPECT_EQ(plan->end_time(), 10e-6);
}

}  // namespace
