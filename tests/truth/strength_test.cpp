// The strength of a body whose springs break at a strain limit. A block between smooth walls, under
// pressure from the sides, breaks at the stress at which the strain in some direction reaches the
// limit. See docs/theory/strength.md.
#include <support/scenes.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace strength_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr double young = 10e9, poisson = 0.2, limit = 1e-3;

/// The stress along z, Pa, at which the first spring breaks while the stress grows slowly to
/// `full`. Both arguments are pressures, Pa.
double strength(double sideways, double full) {
  constexpr double end = 5e-4;
  SceneBuilder scene;
  scene.lattice("lattices.cubic", 1e-3, box_mm(4, 4, 4), {{"boundary", "cells"}})
      .material("materials.elastic", {{"young", young},
                                      {"poisson", poisson},
                                      {"density", 2500},
                                      {"membrane", "I-m"},
                                      {"stiffness", "bulk"},
                                      {"failure", {{"type", "failures.strain"}, {"limit", limit}}}})
      .load("loads.pressure",
            {{"name", "top"}, {"on", "z_max"}, {"pressure", full}, {"rise", end}});
  for (const std::string axis : {"x", "y", "z"}) {
    scene.load("loads.fixed", {{"name", "wall_" + axis}, {"on", axis + "_min"}, {"axes", axis}});
    if (axis != "z" && sideways > 0)
      scene.load("loads.pressure", {{"name", "side_" + axis},
                                    {"on", axis + "_max"},
                                    {"pressure", sideways},
                                    {"rise", 5e-5}});
  }
  const auto plan = plan_of(scene.solver("solvers.explicit", {{"end_time", end}}).text());
  Simulation simulation(*plan->model, 1);
  simulation.set_damping(0.8);
  const double step = 0.8 * plan->model->step_limit.time_step / std::sqrt(1.8);
  while (simulation.breakages().empty() && simulation.time() < end) simulation.step(step);
  return simulation.breakages().empty() ? HUGE_VAL : simulation.time() / end * full;
}

TEST(Strength, UnderPressureGrowsWithThatFromTheSide) {
  for (const double sideways : {0.0, 5e6, 20e6}) {
    const double expected = (young * limit + (1 - poisson) * sideways) / poisson;
    EXPECT_NEAR(strength(sideways, 160e6) / expected, 1, 0.02)
        << sideways;  // a strain of 1 % is not quite small
  }
}

TEST(Strength, UnderTensionFallsWithPressureFromTheSide) {
  for (const double sideways : {0.0, 5e6, 10e6})
    EXPECT_NEAR(-strength(sideways, -15e6) / (young * limit - 2 * poisson * sideways), 1, 0.02)
        << sideways;
}

}  // namespace strength_test
