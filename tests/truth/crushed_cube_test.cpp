// A cube between smooth platens: the largest stress that it bears is the compressive strength of
// its surface, whatever the spacing, and it does not fail from its edges first. See
// docs/theory/cohesive.md.
#include <support/laws.hpp>
#include <support/scenes.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace crushed_cube_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr double spacing = 1e-3, strength = 3e6, ratio = 10;
constexpr int edge = 12;  // cells, four lengths of damage

/// Returns the largest stress on the platens over the compressive strength, and the last one.
std::pair<double, double> crush(const Keys& elastic) {
  constexpr double speed = 0.1, rise = 20e-6, end = 300e-6;
  const auto plan = plan_of(
      SceneBuilder{}
          .lattice("lattices.cubic", spacing, box_mm(edge, edge, edge), {{"boundary", "cells"}})
          .material("materials.elastic",
                    elastic + Keys{{"young", 3e10},
                                   {"density", 2400},
                                   {"failure", Keys{{"type", "failures.cohesive"},
                                                    {"strength", strength},
                                                    {"compressive_strength", ratio * strength},
                                                    {"fracture_energy", 20},
                                                    {"length", 3 * spacing},
                                                    {"intact_near_supports", false}}
                                                   .json()}})
          .load("loads.fixed", {{"on", "z_min"}, {"axes", "z"}})
          .load("loads.velocity",
                {{"on", "z_max"}, {"axes", "z"}, {"value", Vec3{0, 0, -speed}}, {"rise", rise}})
          .solver("solvers.explicit", {{"end_time", end}})
          .text(),
      2);
  const Model& model = *plan->model;
  Simulation simulation(model, 2);
  simulation.set_damping(0.1);
  const double dt = 0.85 * model.step_limit.time_step;
  const double whole = ratio * strength * (edge * spacing) * (edge * spacing);
  double most = 0, last = 0;
  while (simulation.time() < end) {
    for (int n = 0; n < 5; ++n) simulation.step(dt);
    last = std::abs(simulation.force_on_load().front().z) / whole;
    most = std::max(most, last);
  }
  return {most, last};
}

TEST(CrushedCube, BearsItsCompressiveStrength) {
  const std::pair<const char*, Keys> membranes[] = {
      {"none", {{"poisson", 0.25}}},
      {"I-m", {{"poisson", 0.2}, {"membrane", "I-m"}}},
      {"volumetric", {{"poisson", 0.35}}}};
  for (const auto& [name, elastic] : membranes) {
    const auto [most, last] = crush(elastic);
    std::printf("%s: peak %.4f of the compressive strength, %.3f at the end\n", name, most, last);
    EXPECT_NEAR(most, 1, 0.03) << name;
    EXPECT_LT(last, 0.1) << name;
  }
}

}  // namespace crushed_cube_test
