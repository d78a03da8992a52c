// States of rest with numbers of very different size: heights a billion times as stiff as the
// springs in space, or almost free; loads of 1e-300 N, loads that cancel, and loads that end at
// zero. The truth is the closed form of a cube between frictionless planes.
#include <support/lists.hpp>
#include <support/rest.hpp>

#include <gtest/gtest.h>

namespace rest_extremes_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr double size = 4e-3;  // m

Stages rollers() {
  Stages all;
  for (const std::string axis : {"x", "y", "z"})
    all =
        all + stage("loads.fixed", {{"on", axis + "_min"}, {"axes", axis}, {"name", "on_" + axis}});
  return all;
}
std::string cube(const Keys& material, const Stages& stages) {
  return scene({{"spacing", 1e-3}, {"boundary", "cells"}, {"shape", box({}, {size, size, size})}},
               elastic(1e9, material) + stages);
}
Keys membrane_I_m(double poisson) { return {{"membrane", "I-m"}, {"poisson", poisson}}; }
Stages pulled(double strain) {
  return rollers() +
         stage("loads.displacement",
               {{"on", "x_max"}, {"axes", "x"}, {"rise", 1}, {"value", Vec3{strain * size, 0, 0}}});
}
Stages force(double newton, const Keys& more = {}) {
  return stage("loads.force", Keys{{"on", "x_max"}, {"total", Vec3{newton, 0, 0}}} + more);
}

TEST(RestExtremes, HeightsOfAnyStiffness) {
  for (const Json& k_alpha : {Json(1e-3), Json(1), Json(1e6), Json(1e7), Json(1e8), Json(1e9),
                              Json(1e12), Json(1e30), Json("infinite")}) {
    const AtRest body(cube({{"membrane", "free"}, {"k_beta", 1}, {"k_alpha", k_alpha}},
                           rollers() +
                               stage("loads.pressure", {{"on", "x_max"}, {"pressure", -1e3}}) +
                               stage("solvers.static")));
    EXPECT_NEAR(body.mean(0, [](Site s) { return s.i == 4; }) / (1e-6 * size), 1, 1e-5) << k_alpha;
    EXPECT_LE(body.report.iterations, 10u) << k_alpha;
  }
}

TEST(RestExtremes, HeightsOfAnyStiffnessInALongList) {
  const ListFiles files(12, 12, 12);
  for (const char* preconditioner : {"multigrid", "incomplete"}) {
    std::uint64_t common = 0;
    for (const double k_alpha : {1.0, 1e9}) {
      const AtRest body(
          listed_scene(files.lattice(), {{"membrane", "free"}, {"k_beta", 1}, {"k_alpha", k_alpha}},
                       stage("loads.fixed", {{"on", box({-1, -1, -1}, {1e-3, 1, 1})}}) +
                           force(1e-3, {{"on", box({11e-3, -1, -1}, {1, 1, 1})}}) +
                           stage("solvers.static", {{"preconditioner", preconditioner}})));
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
      const AtRest body(cube(membrane_I_m(nu), pulled(strain) + stage("solvers.static")));
      EXPECT_NEAR(body.mean(1, [](Site s) { return s.j == 4; }) / size, -nu * strain,
                  std::abs(strain) * (1e-4 + 2 * std::abs(strain)))
          << nu << " " << strain;
      EXPECT_LE(body.report.iterations, 20u) << nu << " " << strain;
    }
}

TEST(RestExtremes, ABodyThatWrinklesIsToldSo) {
  for (const auto& [nu, strain] :
       {std::pair{0.2499, -1e-3}, {0.24999, -1e-4}, {0.24999, -1e-3}, {0.24999, -5e-3}}) {
    const std::string text = failure_of(
        cube(membrane_I_m(nu), pulled(strain) + stage("solvers.static", {{"most_cutbacks", 3}})));
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
       {std::pair{0.2499, 1e6}, {0.2499, 3e6}, {0.24999, 1e6}, {0.24999, 3e6}}) {
    const std::string text = failure_of(cube(
        membrane_I_m(nu), stage("loads.fixed", {{"on", "x_min"}}) +
                              stage("loads.pressure", {{"on", "x_max"}, {"pressure", pressure}}) +
                              stage("solvers.static")));
    EXPECT_NE(text.find("wrinkles in the fourth dimension"), std::string::npos)
        << nu << " " << pressure << ": " << text;
  }
}

TEST(RestExtremes, TheSmallestLoadsMoveInProportion) {
  const auto moved = [](double newton) {
    const AtRest body(cube(membrane_I_m(0.1), rollers() + force(newton) + stage("solvers.static")));
    return body.mean(0, [](Site s) { return s.i == 4; });
  };
  const double per_newton = moved(1e-6) / 1e-6;
  EXPECT_NEAR(per_newton * 1e9 * size, 1, 1e-5);
  for (const double newton : {1e-100, 1e-200, 1e-290})
    EXPECT_NEAR(moved(newton) / newton / per_newton, 1, 1e-5) << newton;
}

TEST(RestExtremes, TheLargestLoadsAreToldApart) {
  EXPECT_NE(
      failure_of(cube({{"membrane", "none"}},
                      rollers() + force(1e300) + stage("solvers.static", {{"most_cutbacks", 2}})))
          .find("finds no state of rest"),
      std::string::npos);
}

TEST(RestExtremes, LoadsThatCancelMoveNothing) {
  const AtRest body(
      cube(membrane_I_m(0.1),
           rollers() + force(1e3) + force(-1e3, {{"name", "against"}}) + stage("solvers.static")));
  EXPECT_LT(largest(body.u), 1e-12 * size);
}

// At the end of the second stage no force is left, so that the residual has only round-off as its
// scale.
TEST(RestExtremes, ALoadThatGoesAwayLeavesNothing) {
  for (const char* solver : {R"("type": "solvers.static")",
                             R"("type": "solvers.relaxation", "method": "accelerated")"}) {
    const auto plan =
        plan_of(cube(membrane_I_m(0.1),
                     rollers() +
                         stage("loads.expression", {{"on", "x_max"},
                                                    {"total", Vec3{1e6 * size * size, 0, 0}},
                                                    {"expression", "t < 1 ? t : 2 - t"},
                                                    {"corners", {1}}}) +
                         (solver + Keys{{"end_time", 1}}) + (solver + Keys{{"end_time", 2}})),
                1);
    Simulation simulation(*plan->model, 1);
    StageCalls(*plan->model, simulation, plan->stages[0], 1, {}).run();
    EXPECT_NEAR(largest(displacements(simulation)), 1e-3 * size, 1e-5 * size) << solver;
    StageCalls(*plan->model, simulation, plan->stages[1], 1, {}).run();
    EXPECT_LT(largest(displacements(simulation)), 1e-8 * size) << solver;
  }
}

}  // namespace rest_extremes_test
