// States of rest with numbers of very different size: heights a billion times as stiff as the
// springs in space, or almost free; loads of 1e-300 N, loads that cancel, and loads that end at
// zero. The truth is the closed form of a cube between frictionless planes.
#include <support/lists.hpp>
#include <support/rest.hpp>

#include <gtest/gtest.h>

namespace {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr double size = 4e-3;  // m

std::string rollers() {
  std::string text;
  for (const std::string axis : {"x", "y", "z"})
    text += R"({ "type": "loads.fixed", "on": ")" + axis + R"(_min", "axes": ")" + axis +
            R"(", "name": "on_)" + axis + R"(" }, )";
  return text;
}
std::string cube(const std::string& material, const std::string& stages) {
  return scene(R"("spacing": 1e-3, "boundary": "cells", "shape": )" + box({}, {size, size, size}),
               elastic(1e9, material) + stages);
}
std::string pulled(double strain) {
  return rollers() +
         R"({ "type": "loads.displacement", "on": "x_max", "axes": "x", "rise": 1, "value": [)" +
         number(strain * size) + ", 0, 0] }, ";
}

TEST(RestExtremes, HeightsOfAnyStiffness) {
  for (const char* k_alpha :
       {"1e-3", "1", "1e6", "1e7", "1e8", "1e9", "1e12", "1e30", "\"infinite\""}) {
    const AtRest body(cube(
        R"("membrane": "free", "k_beta": 1, "k_alpha": )" + std::string(k_alpha),
        rollers() +
            R"({ "type": "loads.pressure", "on": "x_max", "pressure": -1e3 }, { "type": "solvers.static" })"));
    EXPECT_NEAR(body.mean(0, [](Site s) { return s.i == 4; }) / (1e-6 * size), 1, 1e-5) << k_alpha;
    EXPECT_LE(body.report.iterations, 10u) << k_alpha;
  }
}

TEST(RestExtremes, HeightsOfAnyStiffnessInALongList) {
  const ListFiles files(12, 12, 12);
  for (const char* preconditioner : {"multigrid", "incomplete"}) {
    std::uint64_t common = 0;
    for (const char* k_alpha : {"1", "1e9"}) {
      const AtRest body(listed_scene(
          files.lattice(), R"("membrane": "free", "k_beta": 1, "k_alpha": )" + std::string(k_alpha),
          R"({ "type": "loads.fixed", "on": )" + box({-1, -1, -1}, {1e-3, 1, 1}) +
              R"( }, { "type": "loads.force", "total": [1e-3, 0, 0], "on": )" +
              box({11e-3, -1, -1}, {1, 1, 1}) +
              R"( }, { "type": "solvers.static", "preconditioner": ")" + preconditioner +
              R"(" })"));
      if (common == 0) common = body.report.iterations;
      EXPECT_LE(body.report.iterations, 2 * common) << preconditioner << " " << k_alpha;
      EXPECT_GT(largest(body.u), 0);
    }
  }
}

std::string failure_of(const std::string& scene) {
  try {
    const AtRest body(scene);
    return "";
  } catch (const RunError& error) {
    return error.what();
  }
}

// lambda = 7 (1 - 4 nu) / (1 + 5 nu) falls to 1.2e-4. Strains of 1e-3 then change the stiffness of
// the heights many times over.
TEST(RestExtremes, PoissonRatiosJustBelowAQuarter) {
  for (const double nu : {0.0, 0.2, 0.24, 0.249, 0.2499, 0.24999})
    for (const double strain : {5e-3, 1e-3, 1e-5, -1e-6}) {
      const AtRest body(cube(R"("membrane": "I-m", "poisson": )" + number(nu),
                             pulled(strain) + R"({ "type": "solvers.static" })"));
      EXPECT_NEAR(body.mean(1, [](Site s) { return s.j == 4; }) / size, -nu * strain,
                  std::abs(strain) * (1e-4 + 2 * std::abs(strain)))
          << nu << " " << strain;
      EXPECT_LE(body.report.iterations, 20u) << nu << " " << strain;
    }
}

TEST(RestExtremes, ABodyThatWrinklesIsToldSo) {
  for (const auto& [nu, strain] :
       {std::pair{0.2499, -1e-3}, {0.24999, -1e-4}, {0.24999, -1e-3}, {0.24999, -5e-3}}) {
    const std::string text =
        failure_of(cube(R"("membrane": "I-m", "poisson": )" + number(nu),
                        pulled(strain) + R"({ "type": "solvers.static", "most_cutbacks": 3 })"));
    EXPECT_NE(text.find("stiffness against a motion is negative"), std::string::npos)
        << nu << " " << strain << ": " << text;
    EXPECT_NE(text.find("wrinkles in the fourth dimension"), std::string::npos)
        << nu << " " << strain << ": " << text;
  }
}

// Under this pressure the solver finds no state of rest: the heights run away, and the message says
// that the body wrinkles.
TEST(RestExtremes, ABodyThatAPressureWrinklesIsToldSo) {
  for (const auto& [nu, pressure] :
       {std::pair{0.2499, "1e6"}, {0.2499, "3e6"}, {0.24999, "1e6"}, {0.24999, "3e6"}}) {
    const std::string text =
        failure_of(cube(R"("membrane": "I-m", "poisson": )" + number(nu),
                        R"({ "type": "loads.fixed", "on": "x_min" },
          { "type": "loads.pressure", "on": "x_max", "pressure": )" +
                            std::string(pressure) + R"( }, { "type": "solvers.static" })"));
    EXPECT_NE(text.find("wrinkles in the fourth dimension"), std::string::npos)
        << nu << " " << pressure << ": " << text;
  }
}

TEST(RestExtremes, TheSmallestLoadsMoveInProportion) {
  const auto moved = [](const std::string& force) {
    const AtRest body(cube(R"("membrane": "I-m", "poisson": 0.1)",
                           rollers() + R"({ "type": "loads.force", "on": "x_max", "total": [)" +
                               force + R"(, 0, 0] }, { "type": "solvers.static" })"));
    return body.mean(0, [](Site s) { return s.i == 4; });
  };
  const double per_newton = moved("1e-6") / 1e-6;
  EXPECT_NEAR(per_newton * 1e9 * size, 1, 1e-5);
  for (const char* force : {"1e-100", "1e-200", "1e-290"})
    EXPECT_NEAR(moved(force) / std::stod(force) / per_newton, 1, 1e-5) << force;
}

TEST(RestExtremes, TheLargestLoadsAreToldApart) {
  EXPECT_NE(failure_of(cube(R"("membrane": "none")",
                            rollers() +
                                R"({ "type": "loads.force", "on": "x_max", "total": [1e300, 0, 0] },
      { "type": "solvers.static", "most_cutbacks": 2 })"))
                .find("finds no state of rest"),
            std::string::npos);
}

TEST(RestExtremes, LoadsThatCancelMoveNothing) {
  const AtRest body(
      cube(R"("membrane": "I-m", "poisson": 0.1)",
           rollers() + R"({ "type": "loads.force", "on": "x_max", "total": [1e3, 0, 0] },
      { "type": "loads.force", "name": "against", "on": "x_max", "total": [-1e3, 0, 0] }, { "type": "solvers.static" })"));
  EXPECT_LT(largest(body.u), 1e-12 * size);
}

// At the end of the second stage no force is left, so that the residual has only round-off as its
// scale.
TEST(RestExtremes, ALoadThatGoesAwayLeavesNothing) {
  for (const char* solver : {R"("type": "solvers.static")",
                             R"("type": "solvers.relaxation", "method": "accelerated")"}) {
    const auto plan =
        plan_of(cube(R"("membrane": "I-m", "poisson": 0.1)",
                     rollers() + R"({ "type": "loads.expression", "on": "x_max",
        "total": [)" + number(1e6 * size * size) +
                         R"(, 0, 0], "expression": "t < 1 ? t : 2 - t", "corners": [1] }, { )" +
                         std::string(solver) + R"(, "end_time": 1 }, { )" + solver +
                         R"(, "end_time": 2 })"),
                1);
    Simulation simulation(*plan->model, 1);
    StageCalls(*plan->model, simulation, plan->stages[0], 1, {}).run();
    EXPECT_NEAR(largest(displacements(simulation)), 1e-3 * size, 1e-5 * size) << solver;
    StageCalls(*plan->model, simulation, plan->stages[1], 1, {}).run();
    EXPECT_LT(largest(displacements(simulation)), 1e-8 * size) << solver;
  }
}

}  // namespace
