// Damage in partial cells: a round bar, whose surface cuts through cells, has the strength of its
// material over the area of its circle, and a crack through it takes its fracture energy.
#include <support/cohesive_bar.hpp>
#include <support/rest.hpp>
#include <support/scenes.hpp>

#include <engine/stage_calls.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace damage_partial_cells_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

using cohesive_bar::spacing, cohesive_bar::strength, cohesive_bar::young;
constexpr double length = 3e-3, radius = 2.6e-3;

/// Largest force over strength and area, and what the crack took over toughness and area.
struct Bounds {
  double peak = 0, taken = 0, error = 0;
};

/// Pulls a round bar, 4 b long, apart between states of rest. Its middle is weaker by 0.5 %.
Bounds pull(const char* boundary, double poisson) {
  const double modulus = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson)),
               toughness = 3.6 * length * strength * strength / modulus, half = 2 * length;
  const auto material = [&](double share, const Keys& more) {
    return cohesive_bar::cohesive(poisson, length, {{"strength", share * strength}}) + more;
  };
  const Json bar = {
      {"cylinder", {{"start", {0, 0, 0}}, {"end", {2 * half, 0, 0}}, {"radius", radius}}}};
  const Json middle = box({half - spacing, -1, -1}, {half + spacing, 1, 1});
  const auto plan = plan_of(
      SceneBuilder{}
          .lattice("lattices.cubic", spacing, bar,
                   {{"boundary", boundary}, {"anchor", {0.0, 0.0, 0.0}}})
          .material("materials.elastic", material(1, {}))
          .material("materials.elastic", material(0.995, {{"name", "weak"}, {"region", middle}}))
          .load("loads.fixed", {{"name", "left"}, {"on", "x_min"}, {"axes", "x"}})
          .load("loads.displacement", {{"name", "right"},
                                       {"on", "x_max"},
                                       {"axes", "x"},
                                       {"value", Vec3{2.2e-5, 0, 0}},
                                       {"rise", 1}})
          .load(
              "loads.fixed",
              {{"name", "axis"}, {"on", box({-1, -1e-5, -1e-5}, {1, 1e-5, 1e-5})}, {"axes", "yz"}})
          .load("loads.fixed", {{"name", "turn"},
                                {"on", box({-1, 0.9e-3, -1e-5}, {1e-5, 1.1e-3, 1e-5})},
                                {"axes", "z"}})
          .solver("solvers.static", {{"end_time", 1}, {"damage_step", 0.1}})
          .text());
  Simulation simulation(*plan->model, 1);
  const double area = std::numbers::pi * radius * radius;
  Bounds found;
  StageCalls::Hooks hooks;
  hooks.observe = [&] {
    found.peak = std::max(found.peak, -simulation.force_on_load()[1].x / (area * strength));
  };
  StageCalls(*plan->model, simulation, plan->stages.front(), 1, hooks).run();
  const EnergyBalance end = simulation.balance();
  found.taken = (end.dissipated_failure + end.stored) / (toughness * area);
  found.error = end.relative_error();
  std::printf("%s, nu %.2f: peak %.4f, taken %.4f, error %.1e\n", boundary, poisson, found.peak,
              found.taken, found.error);
  return found;
}

TEST(DamageOfPartialCells, ARoundBarHasItsStrengthAndTakesItsFractureEnergy) {
  for (const double poisson : {0.25, 0.2}) {
    const Bounds partial = pull("partial_cells", poisson);
    EXPECT_NEAR(partial.peak, 1, 0.02) << poisson;
    EXPECT_NEAR(partial.taken, 1, 0.04) << poisson;
    EXPECT_LT(std::abs(partial.error), 1e-3);
  }
}

}  // namespace damage_partial_cells_test
