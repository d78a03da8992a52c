// Bodies with the volumetric energy of cells against an independent prototype: frequencies, elastic
// response of finite bodies, cut planes, and the statics of what the steps in time do.
// convergence_test.cpp has finite elements.
#include <support/cells.hpp>
#include <support/rest.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace volumetric_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

/// Returns omega_max^2 m / k of the critical step, with the mass m of a whole particle.
double squared_frequency(const Model& model) {
  const Material& material = model.materials[0];
  return std::pow(2 / model.step_limit.time_step, 2) * material.mass /
         material.constants.base_stiffness;
}

struct Frequencies {
  double poisson, endless, one_cell, cube;  ///< omega_max^2 m / k; the cube has 8^3 cells
};
const Frequencies frequencies[] = {{0.3, 14, 26, 15.600},
                                   {0.4, 24, 56, 29.117},
                                   {0.45, 44, 116, 56.554},
                                   {0.49, 204, 596, 276.829}};

TEST(Volumetric, LimitsTheStepAsThePrototype) {
  for (const Frequencies& of : frequencies) {
    const Keys material = {{"poisson", of.poisson}};
    EXPECT_NEAR(squared_frequency(*plan_of(block(8, 8, 8, material))->model) / of.endless, 1, 1e-6)
        << of.poisson;
    const auto of_cells = [&](int n) {
      return squared_frequency(*plan_of(scene_of_cells(box_mm(n, n, n), material))->model);
    };
    EXPECT_NEAR(of_cells(1) / of.one_cell, 1, 1e-12) << of.poisson;
    // 25 products find the frequency from below, to 2 % for certain.
    const double of_cube = of_cells(8) / (1.02 * 1.02);
    EXPECT_LT(of_cube, of.cube * (1 + 1e-5)) << of.poisson;
    EXPECT_GT(of_cube * 1.02 * 1.02, of.cube) << of.poisson;
    EXPECT_GT(of_cube, 0.99 * of.cube) << of.poisson;
  }
}

/// Below 1/4 the volumetric energy only lowers frequencies: bodies of whole particles have the step
/// of their springs, 12 k / m; one cell has its own stiffest motion, 16.
TEST(Volumetric, BelowAQuarterTheStepIsThatOfTheSprings) {
  for (const double poisson : {0.0, -0.5}) {
    const Keys material = {{"poisson", poisson}, {"volumetric", true}};
    EXPECT_NEAR(squared_frequency(*plan_of(block(6, 6, 6, material))->model), 12, 1e-6);
    EXPECT_NEAR(squared_frequency(*plan_of(scene_of_cells(box_mm(1, 1, 1), material))->model), 16,
                1e-11);
  }
}

/// A cube between frictionless platens: nu and E over the E of the material, for the area (N l)^2.
struct Pressed {
  double poisson = 0, modulus = 0;
  std::uint64_t iterations = 0;
};
Pressed press(int n, const std::string& boundary, double poisson, double tolerance) {
  constexpr double strain = 1e-10;
  const double size = n;
  const AtRest cube(scene(
      {{"spacing", 1}, {"shape", box({}, {size, size, size})}, {"boundary", boundary}},
      elastic(1, {{"poisson", poisson}, {"volumetric", true}}) +
          stage("loads.fixed", {{"on", "z_min"}, {"axes", "z"}}) +
          stage(
              "loads.displacement",
              {{"on", "z_max"}, {"axes", "z"}, {"value", {0, 0, strain * size}}, {"rise", 1e-9}}) +
          stage("solvers.static", {{"tolerance", tolerance}})));
  const Body& body = cube.model().body;
  const double span = boundary == "cells" ? n : n - 1, stretch = strain * size / span;
  Pressed found;
  found.iterations = cube.report.iterations;
  const auto at = [](std::int32_t Site::*axis, std::int32_t where) {
    return [axis, where](Site site) { return site.*axis == where; };
  };
  for (const auto& [axis, number, low, high] :
       {std::tuple{&Site::i, 0U, body.low.i, body.high.i}, {&Site::j, 1U, body.low.j, body.high.j}})
    found.poisson -=
        (cube.mean(number, at(axis, high)) - cube.mean(number, at(axis, low))) / span / stretch / 2;
  found.modulus = -cube.simulation->force_on_load().at(1).z / (size * size) / stretch;
  return found;
}

TEST(Volumetric, BodiesOfCellsHaveTheModuliOfTheMaterial) {
  for (const double poisson : {-0.9, -0.5, 0.0, 0.3, 0.4, 0.45, 0.49})
    for (const int n : {4, 6}) {
      const Pressed cube = press(n, "cells", poisson, 1e-11);
      EXPECT_NEAR(cube.poisson, poisson, 1e-8) << n;
      EXPECT_NEAR(cube.modulus, 1, 1e-8) << poisson << ", " << n;
    }
}

/// The number of iterations does not grow with the body: rows longer than a vector, too, have the
/// tangent of their own cells. (Seven cells take 14.)
TEST(Volumetric, MultigridTakesFewIterations) {
  for (const int n : {7, 9}) EXPECT_LT(press(n, "cells", 0.45, 1e-8).iterations, 30U) << n;
}

/// The prototype's table for bodies of whole particles, to its last digit.
TEST(Volumetric, BodiesOfParticlesAreSofterAtTheirSurface) {
  for (const auto& [poisson, n, nu, modulus] : {std::tuple{0.3, 5, .2748, .874},
                                                {0.3, 10, .2883, .938},
                                                {0.45, 5, .4168, .873},
                                                {0.45, 10, .4363, .938},
                                                {0.49, 10, .4797, .941},
                                                {0.0, 10, .0440, .987}}) {
    const Pressed cube = press(n, "particles", poisson, 1e-8);
    EXPECT_NEAR(cube.poisson, nu, 6e-5) << poisson << ", " << n;
    EXPECT_NEAR(cube.modulus, modulus, 6e-4) << poisson << ", " << n;
  }
}

/// After all springs through a plane are cut, nothing of the volumetric energy pulls across it: the
/// two parts fly apart without forces between them.
TEST(Volumetric, CellsWithoutASpringCarryNothing) {
  const Keys failure = {{"failure", {{"type", "failures.strain"}, {"limit", 1e-4}}}};
  const auto plan = plan_of(scene_of_cells(box_mm(4, 4, 5), Keys{{"poisson", 0.45}} + failure));
  const Model& model = *plan->model;
  Simulation simulation(model, 1);
  // The layer of cells 2 < z < 3 is stretched along z; all else is at rest.
  std::vector<double> u(3 * model.body.particles);
  for (Particle p = 0; p < model.body.particles; ++p)
    u[3 * p + 2] = corner_of(model, p)[2] >= 3 ? 1e-6 : 0;
  simulation.set_displacements(u, {});
  const double dt = 1e-3 * model.step_limit.time_step;
  simulation.step(dt);  // finds the springs that break
  EXPECT_GT(simulation.breakages().size(), 0U);
  const double lost = simulation.balance().dissipated_failure;
  EXPECT_GT(lost, 0);
  // What springs are left in the layer lie across z and are at rest, so no force is left.
  std::vector<double> before, after;
  simulation.velocities(before);
  simulation.step(dt);
  simulation.velocities(after);
  EXPECT_LT(distance(before, after), 1e-6 * largest(before));
}

TEST(Volumetric, RefusesWhatItCannotDo) {
  const auto why = [](const std::string& text) -> std::string {
    try {
      plan_of(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const Keys failure = {{"failure", {{"type", "failures.elongation"}, {"limit", 1e-6}}}};
  EXPECT_EQ(why(block(4, 4, 4, Keys{{"poisson", 0.4}} + failure)), "");
  EXPECT_NE(why(block(4, 4, 4, Keys{{"poisson", 0.1}, {"volumetric", true}} + failure))
                .find("K_v below zero"),
            std::string::npos);
  EXPECT_NE(why(block(4, 4, 4, {{"poisson", 0.1}})).find("volumetric true reaches it"),
            std::string::npos);
  EXPECT_NE(why(block(4, 4, 4, {{"poisson", 0.4}}, {}, "lattices.fcc")).find("cubic cells"),
            std::string::npos);
  EXPECT_NE(why(block(4, 4, 4, {{"membrane", "I-m"}, {"poisson", 0.1}, {"volumetric", true}}))
                .find("/pipeline/1/volumetric"),
            std::string::npos);
}

/// A static solver ends where damped steps in time end.
TEST(Volumetric, StaticsAndStepsComeToTheSameRest) {
  const Keys lattice = {{"spacing", 1}, {"shape", box({}, {3, 3, 6})}, {"boundary", "cells"}};
  const Stages loads = stage("loads.fixed", {{"on", "z_min"}}) +
                       stage("loads.force", {{"on", "z_max"}, {"total", {2e5, 0, 1e6}}});
  const Stages material = elastic(1e6, {{"poisson", 0.45}});
  const AtRest by_steps(
      scene(lattice, material + loads + stage("solvers.relaxation", {{"tolerance", 1e-9}}))),
      by_statics(scene(lattice, material + loads + to_rest));
  EXPECT_GT(largest(by_statics.u), 0.3);
  EXPECT_LT(distance(by_steps.u, by_statics.u), 1e-6 * largest(by_statics.u));
}

}  // namespace volumetric_test
