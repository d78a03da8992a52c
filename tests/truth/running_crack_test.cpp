// The energy that a slowly running crack takes is the fracture energy of its material, in several
// directions of the lattice. See docs/theory/cohesive.md.
#include <support/laws.hpp>
#include <support/scenes.hpp>

#include <state/damage_field.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

namespace running_crack_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr double spacing = 1e-3, young = 1e10, strength = 1e7, density = 2500;

struct Case {
  const char* name;
  double degrees;  ///< of the crack from the x axis
  int ratio;       ///< length of damage over the spacing
  double poisson = 0.25;
};

/// A strip, one cell thick, at an angle to the lattice, with a notch from its left end. Grips pull
/// its long edges apart, each segment of them in proportion to 1.5 - x / L. So the energy release
/// rate falls ahead of the crack, which runs as slowly as the grips move.
struct Strip {
  double length, toughness, height, extent, notch, modulus, end_time;
  Vec3 along, across;
  std::unique_ptr<Plan> plan;

  static Json half_space(Vec3 point, Vec3 normal) {
    return {{"half_space",
             {{"point", {point.x, point.y, point.z}}, {"normal", {normal.x, normal.y, normal.z}}}}};
  }

  explicit Strip(const Case& one)
      : length(one.ratio * spacing), height(12 * length), extent(30 * length), notch(12 * length) {
    const double nu = one.poisson, angle = one.degrees * std::numbers::pi / 180;
    modulus = young * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
    toughness = 3.6 * length * strength * strength / modulus * (1 + 0.175 / one.ratio);
    end_time = 40 * extent / std::sqrt(modulus / density);
    along = {std::cos(angle), std::sin(angle), 0};
    across = {-std::sin(angle), std::cos(angle), 0};
    const Vec3 top = height / 2 * across;
    const Json layer = {{"box", {{"low", {-1, -1, 0}}, {"high", {1, 1, spacing}}}}};
    const Json strip = {{"intersection",
                         {half_space(top, across), half_space(-1 * top, -1 * across),
                          half_space(extent * along, along), half_space({}, -1 * along), layer}}};
    const Vec3 lift = 0.013 * spacing * across;  // no particle lies on the notch
    const auto corner = [&](double x, double z) {
      const Vec3 at = x * along + lift;
      return Json{at.x, at.y, z};
    };
    const Json cut = {{"polygon",
                       {{"corners",
                         {corner(-spacing, -spacing), corner(notch, -spacing),
                          corner(notch, 2 * spacing), corner(-spacing, 2 * spacing)}}}}};
    SceneBuilder scene;
    scene.stage("lattices.cubic", {{"spacing", spacing},
                                   {"boundary", "cells"},
                                   {"shape", strip},
                                   {"cuts", Json::array({cut})}});
    scene.material("materials.elastic", {{"young", young},
                                         {"poisson", nu},
                                         {"density", density},
                                         {"membrane", nu < 0.25 ? "I-m" : "none"},
                                         {"stiffness", "bulk"},
                                         {"failure", Keys{{"type", "failures.cohesive"},
                                                          {"strength", strength},
                                                          {"fracture_energy", toughness},
                                                          {"length", length},
                                                          {"intact_near_supports", false}}
                                                         .json()}});
    // Half the opening far ahead of the crack, for twice the toughness at the middle.
    const double opening = std::sqrt(2 * toughness * 2 * height / modulus) / 2;
    const int segments = 30;
    for (const double side : {1.0, -1.0}) {
      const Json grip = half_space(side * (height / 2 - 1.5 * spacing) * across, -side * across);
      for (int k = 0; k < segments; ++k) {
        // no particle lies on the border of two segments
        const double from = k == 0 ? -length : k * length + 0.37 * spacing,
                     to = k == segments - 1 ? extent + length : (k + 1) * length + 0.37 * spacing;
        const Vec3 value = side * opening * (1.5 - (k + 0.5) / segments) * across;
        scene.load(
            "loads.displacement",
            {{"name", (side > 0 ? "top" : "bottom") + std::to_string(k)},
             {"on",
              {{"intersection",
                {grip, half_space(to * along, along), half_space(from * along, -1 * along)}}}},
             {"value", value},
             {"axes", "xy"},
             {"rise", end_time}});
      }
    }
    scene.load("loads.fixed", {{"on", "all"}, {"axes", "z"}});
    plan = plan_of(scene.solver("solvers.explicit", {{"end_time", end_time}}).text(), 2);
  }
};

/// Returns the energy that the crack takes per area while it runs on from three lengths beyond its
/// notch, over the toughness.
double energy_of_growth(const Case& one) {
  const Strip strip(one);
  const Model& model = *strip.plan->model;
  Simulation simulation(model, 2);
  const double dt = 0.85 * model.step_limit.time_step;
  std::vector<double> damage(model.body.particles);
  std::vector<std::pair<double, double>> points;  // of the tip, m, and the energy, J
  double tip = strip.notch;
  while (simulation.time() < strip.end_time && tip < strip.extent - 6 * strip.length) {
    for (int n = 0; n < 50; ++n) simulation.step(dt);
    simulation.copy_damage(damage);
    for (Particle p = 0; p < model.body.particles; ++p)
      if (damage[p] > 0.9) tip = std::max(tip, dot(model.body.position(p), strip.along));
    if (tip > strip.notch + 3 * strip.length && tip < strip.extent - 6 * strip.length)
      points.emplace_back(tip, simulation.balance().dissipated_failure);
  }
  if (points.size() < 2) {
    ADD_FAILURE() << one.name << ": the crack has not run, its tip is at " << tip / strip.length
                  << " lengths";
    return 0;
  }
  // the slope of the line through the points
  double x = 0, y = 0, xx = 0, xy = 0;
  const auto count = static_cast<double>(points.size());
  for (const auto& [at, energy] : points) x += at / count, y += energy / count;
  for (const auto& [at, energy] : points) xx += (at - x) * (at - x), xy += (at - x) * (energy - y);
  const double found = xy / xx / spacing / strip.toughness;
  std::printf("%s: b/h %d, %.1f degrees: G / G_c %.4f over %.1f lengths; balance %.1e\n", one.name,
              one.ratio, one.degrees, found,
              (points.back().first - points.front().first) / strip.length,
              simulation.balance().relative_error());
  EXPECT_LT(std::abs(simulation.balance().relative_error()), 1e-4);
  EXPECT_GT(points.back().first - points.front().first, 6 * strip.length);
  return found;
}

/// Runs the cases; each energy is within `within` of the toughness, and all lie within `spread`.
void expect_toughness(const std::vector<Case>& cases, double within, double spread) {
  double least = 1e9, most = 0;
  for (const Case& one : cases) {
    const double found = energy_of_growth(one);
    EXPECT_NEAR(found, 1, within) << one.name << " " << one.degrees;
    least = std::min(least, found), most = std::max(most, found);
  }
  EXPECT_LT(most - least, spread);
}

TEST(RunningCrack, TakesItsFractureEnergyInTwoDirections) {
  expect_toughness({{"none", 0, 3}, {"none", 45, 3}}, 0.08, 0.08);
}
TEST(LongRunningCrack, TakesItsFractureEnergyInThreeDirections) {
  expect_toughness({{"none", 0, 5}, {"none", 22.5, 5}, {"none", 45, 5}}, 0.05, 0.05);
}
TEST(LongRunningCrack, ComesNearerWithAFinerSpacing) {
  expect_toughness({{"none", 0, 10}, {"none", 45, 10}}, 0.045, 0.03);
}
TEST(LongRunningCrack, TakesItsFractureEnergyWithAVolumetricEnergy) {
  expect_toughness({{"nu 0.3", 0, 3, 0.3}, {"nu 0.3", 45, 3, 0.3}}, 0.08, 0.08);
}
TEST(LongRunningCrack, TakesItsFractureEnergyWithAMembrane) {
  expect_toughness({{"I-m", 0, 5, 0.2}, {"I-m", 22.5, 5, 0.2}, {"I-m", 45, 5, 0.2}}, 0.05, 0.05);
}

}  // namespace running_crack_test
