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
  double before = 0;
  for (const double damage_step : {0.05, 0.01}) {
    Motion run(bar(end, {{"time_step", 2e-5}, {"residual", 1e-7}, {"damage_step", damage_step}}));
    double peak = 0, largest = 0;
    run.go([&] {
      peak = std::max(peak, -run.simulation.force_on_load().back().x / area);
      largest = std::max(largest, std::abs(run.simulation.balance().relative_error()));
    });
    const EnergyBalance now = run.simulation.balance();
    // Between states of rest this bar dissipates 0.97 of its toughness; the rest stays stored.
    const double beyond = now.dissipated_failure / (toughness * area) - 0.97;
    std::printf(
        "damage_step %.2f: %llu steps, peak %.4f of the strength, dissipates %.4f of the "
        "toughness too much, balance %.1e\n",
        damage_step, static_cast<unsigned long long>(run.simulation.steps()), peak / strength,
        beyond, largest);
    EXPECT_NEAR(peak / strength, 0.995, 0.03);
    EXPECT_LT(std::abs(beyond), 3 * damage_step + 0.03);
    EXPECT_LT(largest, 1e-5);
    if (before > 0) {
      EXPECT_LT(std::abs(beyond), before);
    }
    before = std::abs(beyond);
  }
}

}  // namespace damage_implicit_test
