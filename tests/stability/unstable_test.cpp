// Unstable lattices are refused with the mode that grows, or run with a warning if the scene allows
// it. Stable lattices with negative stiffness give no message.
#include <model/stability.hpp>
#include <support/scenes.hpp>

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace unstable_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

std::string scene_of(const Keys& material, bool allow,
                     const std::string& lattice = "lattices.cubic", int cells = 4) {
  const std::string scene = block(cells, cells, cells, material, {}, lattice);
  return allow ? SceneBuilder(scene).key("allow_unstable", true).text() : scene;
}

/// The message of the refusal; "" if the scene is accepted.
std::string faults_of(const Keys& material, bool allow,
                      const std::string& lattice = "lattices.cubic") {
  try {
    plan_of(scene_of(material, allow, lattice));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

struct Case {
  const char* material;
  const char* pointer;  ///< pointer of the refusal
  const char* expected;
  const char* grows;  ///< part of the warning
};
const Case unstable[] = {
    {R"("membrane": "III", "lambda": -1.55)", "/pipeline/1/lambda: -1.55",
     "above -1.5: with less, membrane III is unstable", "grows"},
    {R"("membrane": "III", "lambda": -1.5)", "/pipeline/1/lambda: -1.5", "-1.5 is stable with IV",
     ""},
    {R"("membrane": "IV", "lambda": -2.1)", "/pipeline/1/lambda: -2.1",
     "above -2: with less, membrane IV is unstable", "grows"},
    {R"("membrane": "I-m", "lambda": -0.1)", "/pipeline/1/lambda: -0.1",
     "at least 0: with less, membrane I-m is unstable", "height"},
    {R"("membrane": "I", "lambda": -0.1)", "/pipeline/1/lambda: -0.1",
     "at least 0: with less, membrane I is unstable", "height"},
    {R"("membrane": "II", "lambda": -0.1)", "/pipeline/1/lambda: -0.1",
     "at least 0: with less, membrane II is unstable", "height"},
    {R"("membrane": "I-m", "poisson": 0.3)", "/pipeline/1/poisson: 0.3",
     "within (-0.2, 0.25], the reach of membrane I-m", "height"},
    {R"("membrane": "IV", "poisson": 0.4)", "/pipeline/1/poisson: 0.4",
     "within (0, 0.3333), the reach of membrane IV", "grows"},
    {R"("membrane": "free", "k_alpha": 3, "k_beta": -2.5, "k_gamma": 2)",
     "/pipeline/1: ", "springs that make a stable lattice", "wave with vector"},
    {R"("membrane": "free", "k_alpha": -1)", "/pipeline/1: ", "k_alpha alone every height grows",
     ""},
    {R"("membrane": "free", "k_alpha": "infinite", "k_beta": -2.2, "k_gamma": 1)",
     "/pipeline/1: ", "allow_unstable", "grows"},
};

TEST(Unstable, IsRefusedUnlessTheSceneAllowsIt) {
  for (const Case& c : unstable) {
    const std::string faults = faults_of(c.material, false);
    EXPECT_NE(faults.find(c.pointer), std::string::npos) << faults;
    EXPECT_NE(faults.find(c.expected), std::string::npos) << faults;
    const auto plan = plan_of(scene_of(c.material, true));
    if (c.grows[0] == '\0') continue;  // at the limit the mode neither grows nor resists
    ASSERT_EQ(plan->model->warnings.size(), 1u) << c.material;
    EXPECT_NE(plan->model->warnings[0].find(c.grows), std::string::npos)
        << plan->model->warnings[0];
    EXPECT_EQ(plan_json(*plan).at("warnings").at(0), plan->model->warnings[0]);
    EXPECT_NE(plan_text(*plan).find(plan->model->warnings[0]), std::string::npos);
    EXPECT_GT(plan->model->step_limit.time_step, 0);
    EXPECT_TRUE(std::isfinite(plan->model->step_limit.time_step));
  }
}

TEST(Unstable, CentredLatticesToo) {
  for (const char* lattice : {"lattices.bcc", "lattices.fcc"}) {
    const Keys material = {{"membrane", "I-m"}, {"lambda", -0.05}};
    EXPECT_NE(faults_of(material, false, lattice).find("/pipeline/1/lambda"), std::string::npos);
    EXPECT_EQ(plan_of(scene_of(material, true, lattice))->model->warnings.size(), 1u);
  }
}

TEST(Unstable, WhatNoSpringsHaveIsRefusedAnyway) {
  EXPECT_NE(faults_of({{"membrane", "I-m"}, {"poisson", -0.2}}, true).find("within (-0.2, 0.25]"),
            std::string::npos);  // no lambda gives this value
  EXPECT_NE(faults_of({{"membrane", "I-m"}, {"poisson", -0.4}}, true).find("without stiffness"),
            std::string::npos);  // E would be negative
  EXPECT_NE(faults_of({{"poisson", 0.2}}, true).find("/pipeline/1/poisson"), std::string::npos);
  const std::string scene = SceneBuilder(block(4, 4, 4)).key("allow_unstable", 1).text();
  try {
    plan_of(scene);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("/allow_unstable: 1"), std::string::npos)
        << error.what();
  }
}

TEST(Unstable, StableNegativeStiffnessNeedsNoPermission) {
  for (const char* material :
       {R"("membrane": "III", "lambda": -1.45)", R"("membrane": "IV", "lambda": -1.95)",
        R"("membrane": "IV", "poisson": 0.33)",
        R"("membrane": "free", "k_alpha": 3, "k_beta": 2, "k_gamma": -0.5)"}) {
    const auto plan = plan_of(scene_of(material, false));
    EXPECT_TRUE(plan->model->warnings.empty()) << material;
    EXPECT_EQ(plan_text(*plan).find("Warnings"), std::string::npos);
  }
}

// One layer with its mirror image is stable with negative cross springs. Two free layers would move
// apart.
TEST(Unstable, ThePlanSaysIfOnlyTheMirrorKeepsTheLayersTogether) {
  const auto why = [](const Keys& material) {
    const auto plan = plan_of(scene_of(material, false));
    for (const LeftOut& left : plan->left_out)
      if (left.what == "second layer of the membrane") return left.why;
    return std::string("missing");
  };
  EXPECT_NE(why({{"membrane", "IV"}, {"poisson", 0.3}})
                .find("two free ones would not stay so: the wave with vector"),
            std::string::npos);
  EXPECT_EQ(why({{"membrane", "IV"}, {"poisson", 0.2}}),
            "it mirrors the first exactly, so one layer is computed");
}

// The warning must not exaggerate: noise grows at least as fast as the softest wave predicts, since
// surfaces are softer. In a stable lattice noise does not grow.
TEST(Unstable, GrowsAsTheWaveSays) {
  const double size = 1e-16;
  const auto scene = [](double lambda) {
    return scene_of({{"membrane", "IV"}, {"lambda", lambda}}, true, "lattices.cubic", 8);
  };
  const auto growth = [&](double lambda, int steps) {
    const auto plan = plan_of(scene(lambda));
    Simulation simulation(*plan->model, 2);
    simulation.set_displacements(noise(3 * plan->model->body.particles, size), {});
    for (int n = 0; n < steps; ++n) simulation.step(0.9 * plan->model->step_limit.time_step);
    return std::pair{largest(displacements(simulation)) / size,
                     0.9 * steps * plan->model->step_limit.time_step};
  };
  // In membrane IV with k_beta = -3, springs along the axes act as k (1 - 3/2) in space. A grid
  // over the zone gives the softest wave, independently of the tested search.
  const auto plan = plan_of(scene(-3));
  const Model& model = *plan->model;
  const InfiniteLattice lattice{
      model.springs.neighbours,          model.springs.constants,       0,
      model.body.grid.membrane_distance, model.springs.choice.membrane, model.body.grid.spacing};
  double softest = 0;
  for (int i = 0; i <= 8; ++i)
    for (int j = 0; j <= 8; ++j)
      for (int k = 0; k <= 8; ++k) {
        const double step = std::numbers::pi / 8;
        softest = std::min(
            softest,
            stiffness_range(lattice, {i * step, j * step, k * step}, Sector::mirrored).softest);
      }
  const double rate = std::sqrt(-softest / model.materials[0].mass);
  const auto [early, time_early] = growth(-3, 30);
  const auto [late, time_late] = growth(-3, 45);
  const double measured = std::log(late / early) / (time_late - time_early);
  EXPECT_GT(measured, 0.9 * rate);
  EXPECT_LT(measured, 2 * rate);
  EXPECT_LT(growth(-1.9, 500).first, 100);
}

}  // namespace unstable_test
