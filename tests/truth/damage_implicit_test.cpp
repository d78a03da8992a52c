// Damage of cohesive materials in implicit steps: a bar that is pulled slowly softens as between
// states of rest, with the strength and the fracture energy of its material.
#include <state/crack_surface.hpp>
#include <support/motion.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace damage_implicit_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr double young = 1e10, strength = 1e7, spacing = 1e-3, length = 5e-3, poisson = 0.25;
constexpr double modulus = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson));  // Pa
const double toughness = 3.6 * length * strength * strength / modulus;                   // J/m2

/// A bar of one cell by one cell whose two middle layers of cells are weaker by 0.5 %, pulled by
/// 36 um within `end`, s.
std::string bar(double end, const Keys& solver) {
  constexpr int half = 13;
  const auto material = [&](double share, const Keys& more = {}) {
    return stage("materials.elastic",
                 Keys{{"young", young},
                      {"density", 2500},
                      {"poisson", poisson},
                      {"membrane", "none"},
                      {"failure",
                       {{"type", "failures.cohesive"},
                        {"strength", share * strength},
                        {"fracture_energy", toughness * (1 + 0.175 * spacing / length)},
                        {"length", length},
                        {"intact_near_supports", false}}}} +
                     more);
  };
  return SceneBuilder{}
      .lattice("lattices.cubic", spacing, box_mm(2 * half, 1, 1), {{"boundary", "cells"}})
      .stages(material(1))
      .stages(material(
          0.995, {{"name", "weak"}, {"region", box({mm(half - 1), -1, -1}, {mm(half + 1), 1, 1})}}))
      .stage("loads.fixed", {{"on", "x_min"}, {"axes", "x"}})
      .stage("loads.fixed", {{"on", "y_min"}, {"axes", "y"}})
      .stage("loads.fixed", {{"on", "z_min"}, {"axes", "z"}})
      .stage("loads.displacement",
             {{"on", "x_max"}, {"axes", "x"}, {"value", {3.6e-5, 0, 0}}, {"rise", end}})
      .solver("solvers.implicit", Keys{{"end_time", end}} + solver)
      .text();
}

TEST(DamageImplicit, ABarThatIsPulledSlowlySoftens) {
  constexpr double end = 5e-3, area = spacing * spacing;  // 400 times the wave's way
  for (const double step : {5e-5, 2e-5}) {
    Motion run(bar(end, {{"time_step", step}, {"residual", 1e-7}}));
    double peak = 0, last = 0, largest = 0;
    run.go([&] {
      last = -run.simulation.force_on_load().back().x / area;
      peak = std::max(peak, last);
      largest = std::max(largest, std::abs(run.simulation.balance().relative_error()));
    });
    const EnergyBalance now = run.simulation.balance();
    const double cracks = now.dissipated_failure / (toughness * area);
    std::printf(
        "step %.0e s: %llu steps, peak %.4f of the strength, last %.4f, energy %.4f of "
        "the toughness, balance %.1e\n",
        step, static_cast<unsigned long long>(run.simulation.steps()), peak / strength,
        last / strength, cracks, largest);
    EXPECT_NEAR(peak / strength, 0.995, 0.02);
    EXPECT_LT(last, 0.05 * strength);
    EXPECT_NEAR(cracks, 1, 0.1);
    EXPECT_LT(largest, 1e-2);
  }
}

}  // namespace damage_implicit_test
