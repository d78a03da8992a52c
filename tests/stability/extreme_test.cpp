// Extreme cases: large contrasts of stiffness and density, loads and bodies many orders of
// magnitude small or large, bodies far from the origin, bodies that fall apart at once. The result
// must be right; for a body without springs, it must at least be finite.
#include <support/scenes.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace extreme_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

const Keys membrane = {{"membrane", "I-m"}, {"poisson", 0.1}};

/// A bar of 4 x 4 x 10 particles, held at one end and pulled at the other.
struct Bar {
  double spacing = 1e-3, young = 1e10, density = 2500, force = 20,
         from = 0;  ///< `from`: each coordinate of the corner
};

std::string scene_of(const Bar& bar) {
  const auto corner = [&](double i, double j, double k) {
    return Vec3{bar.from + i * bar.spacing, bar.from + j * bar.spacing, bar.from + k * bar.spacing};
  };
  return SceneBuilder{}
      .lattice("lattices.cubic", bar.spacing, box(corner(0, 0, 0), corner(4, 4, 10)))
      .material("materials.elastic",
                Keys{{"young", bar.young}, {"density", bar.density}} + membrane)
      .load("loads.fixed", {{"on", "z_min"}, {"axes", "xyz"}})
      .load("loads.force", {{"on", "z_max"}, {"total", Vec3{0, 0, bar.force}}})
      .solver("solvers.explicit",
              {{"end_time", 1000 * bar.spacing * std::sqrt(bar.density / bar.young)}})
      .text();
}

/// Displacements after 300 steps of half the critical time step, over force / (young spacing). All
/// bars of small strain have the same values.
std::vector<double> response(const Bar& bar) {
  const auto plan = plan_of(scene_of(bar));
  Simulation simulation(*plan->model, 1);
  for (int n = 0; n < 300; ++n) simulation.step(0.5 * plan->model->step_limit.time_step);
  EXPECT_LT(std::abs(simulation.balance().relative_error()), 1e-4);
  auto u = displacements(simulation);
  for (double& value : u) value /= bar.force / (bar.young * bar.spacing);
  return u;
}

TEST(Extreme, ResponsesScaleWithLoadStiffnessDensityAndSize) {
  const auto nominal = response({.force = 1e-6});  // small strains: linear geometry
  EXPECT_GT(largest(nominal), 1);
  const double size = largest(nominal);
  EXPECT_LT(distance(nominal, response({.force = 1e-12})), 1e-6 * size);
  EXPECT_LT(distance(nominal, response({.young = 1e15, .force = 1e-6})), 1e-6 * size);
  EXPECT_LT(distance(nominal, response({.young = 1, .force = 1e-16})), 1e-6 * size);
  EXPECT_LT(distance(nominal, response({.density = 1e-6, .force = 1e-6})), 1e-6 * size);
  EXPECT_LT(distance(nominal, response({.spacing = 1e-9, .force = 1e-18})), 1e-6 * size);
  EXPECT_LT(distance(nominal, response({.spacing = 1e6, .force = 1e12})), 1e-6 * size);
}

TEST(Extreme, ABodyFarFromTheOriginMovesTheSame) {
  // The offset is exact in binary, so that the same sites are filled.
  const auto near = response({}), far = response({.from = 1024});
  EXPECT_LT(distance(near, far), 1e-9 * largest(near));
}

TEST(Extreme, NoLoadIsNoMotion) {
  const auto plan = plan_of(block(5, 5, 5, membrane));
  Simulation simulation(*plan->model, 1);
  for (int n = 0; n < 100; ++n) simulation.step(0.9 * plan->model->step_limit.time_step);
  EXPECT_EQ(largest(displacements(simulation)), 0);
}

/// A block of 6 x 6 x 12 particles whose upper half is of another material.
std::string two_materials(double young, double density) {
  const Keys upper = {
      {"young", young}, {"density", density}, {"region", box({-1, -1, 6e-3}, {1, 1, 1})}};
  return block(6, 6, 12, membrane, stage("materials.elastic", upper + membrane));
}

TEST(Extreme, TwoMaterialsThatAreTheSameAreOne) {
  const auto one = plan_of(block(6, 6, 12, membrane)), two = plan_of(two_materials(1e10, 2500));
  ASSERT_GT(two->model->materials.size(), 1U);
  Simulation a(*one->model, 1), b(*two->model, 2);
  const auto start = noise(3 * one->model->body.particles, 1e-6);
  a.set_displacements(start, {});
  b.set_displacements(start, {});
  for (int n = 0; n < 300; ++n)
    for (Simulation* simulation : {&a, &b})
      simulation->step(0.5 * one->model->step_limit.time_step);
  EXPECT_LT(distance(displacements(a), displacements(b)), 1e-16);
  EXPECT_NEAR(a.balance().stored, b.balance().stored, 1e-9 * a.balance().stored);
}

TEST(Extreme, ContrastsOfStiffnessAndDensityStayStable) {
  for (const auto& [young, density] :
       {std::pair{1e16, 2500.0}, {1e4, 2500.0}, {1e10, 2.5e-3}, {1e10, 2.5e9}, {1e16, 2.5e-3}}) {
    const auto plan = plan_of(two_materials(young, density));
    Simulation simulation(*plan->model, 2);
    simulation.set_displacements(noise(3 * plan->model->body.particles, 1e-10), {});
    simulation.step(0.99 * plan->model->step_limit.time_step);
    const EnergyBalance start = simulation.balance();
    for (int n = 0; n < 2000; ++n) simulation.step(0.99 * plan->model->step_limit.time_step);
    const EnergyBalance end = simulation.balance();
    EXPECT_NEAR((end.kinetic + end.stored) / (start.kinetic + start.stored), 1, 1e-5)
        << young << " Pa, " << density << " kg/m3";
    EXPECT_LT(norm(end.momentum), 1e-9 * std::sqrt(end.kinetic_mean))
        << young << " Pa, " << density << " kg/m3";
  }
}

TEST(Extreme, ABodyMayFallApartInOneStep) {
  const auto plan = plan_of(block(
      6, 6, 6, membrane + Keys{{"failure", {{"type", "failures.elongation"}, {"limit", 1e-15}}}}));
  const Model& model = *plan->model;
  std::vector<double> larger;
  for (Particle p = 0; p < model.body.particles; ++p) {
    const Vec3 x = model.body.position(p);
    larger.insert(larger.end(), {1e-6 * x.x, 1e-6 * x.y, 1e-6 * x.z});
  }
  Simulation simulation(model, 2);
  simulation.set_displacements(larger, {});
  for (int n = 0; n < 50; ++n) simulation.step(0.5 * model.step_limit.time_step);
  EXPECT_EQ(simulation.breakages().size(), model.body.base_springs());
  for (const Breakage& breakage : simulation.breakages()) ASSERT_EQ(breakage.step, 0u);
  EXPECT_LT(std::abs(simulation.balance().relative_error()), 1e-3);
  EXPECT_TRUE(std::isfinite(largest(displacements(simulation))));
}

TEST(Extreme, SmallBodies) {
  for (const auto& [x, y, z] : {std::array{1, 1, 1}, {2, 1, 1}, {1, 1, 9}, {1, 17, 1}, {3, 3, 1}}) {
    const auto plan = plan_of(block(x, y, z, membrane), 3);
    Simulation simulation(*plan->model, 3);
    simulation.set_displacements(noise(3 * plan->model->body.particles, 1e-7), {});
    for (int n = 0; n < 200; ++n) simulation.step(0.9 * plan->model->step_limit.time_step);
    EXPECT_LT(largest(displacements(simulation)), 1e-5) << x << " " << y << " " << z;
    EXPECT_LT(std::abs(simulation.balance().relative_error()), 1e-3) << x << " " << y << " " << z;
  }
}

}  // namespace extreme_test
