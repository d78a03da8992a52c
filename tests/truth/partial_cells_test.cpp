// Bodies of partial cells: their volume, exact equilibrium under homogeneous strain and pressure,
// and sound dynamics. thick_sphere_test.cpp and kirsch_test.cpp measure their convergence.
#include <model/surfaces.hpp>

#include <support/cells.hpp>
#include <support/energy_balance.hpp>
#include <support/growth.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace partial_cells_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr double pi = std::numbers::pi, l = 1e-3;

const Keys partial = {{"boundary", "partial_cells"}};

/// A scene of this shape in mm, filled with partial cells of 1 mm.
std::string scene_of(const Json& shape, const Keys& material = {{"poisson", 0.25}},
                     const Stages& stages = {}, const Keys& lattice = {}) {
  return SceneBuilder{}
      .lattice("lattices.cubic", l, shape, partial + lattice)
      .material("materials.elastic", Keys{{"young", 1e10}, {"density", 2500}} + material)
      .stages(stages)
      .solver("solvers.explicit", {{"end_time", 1e-6}})
      .text();
}

/// A box with the edges 6, 5 and 8 mm, turned in space: half-spaces in common with a box around.
Json turned_box() {
  const Vec3 a = Vec3{1, 0.3, 0.2} / norm(Vec3{1, 0.3, 0.2}),
             b = cross(a, Vec3{0, 0, 1}) / norm(cross(a, Vec3{0, 0, 1})), c = cross(a, b);
  Json parts = Json::array();
  parts.push_back(box({-1e-2, -1e-2, -1e-2}, {1e-2, 1e-2, 1e-2}));
  for (const double side : {-1.0, 1.0})
    for (const auto& [normal, half] : {std::pair{a, 3e-3}, {b, 2.5e-3}, {c, 4e-3}})
      parts.push_back(
          {{"half_space", {{"point", half * side * normal}, {"normal", side * normal}}}});
  return {{"intersection", parts}};
}

Json ball(double radius) { return {{"sphere", {{"radius", radius}}}}; }

struct Solid {
  const char* name;
  Json shape;
  double volume;  ///< m3
};
const std::vector<Solid>& solids() {
  static const std::vector<Solid> all{
      {"ball", ball(4.4e-3), 4 * pi / 3 * std::pow(4.4e-3, 3)},
      {"hollow_ball",
       {{"hollow_sphere", {{"inner_radius", 3e-3}, {"outer_radius", 7.3e-3}}}},
       4 * pi / 3 * (std::pow(7.3e-3, 3) - std::pow(3e-3, 3))},
      {"cylinder",
       {{"cylinder",
         {{"start", Vec3{-2e-3, -3e-3, -4e-3}},
          {"end", Vec3{2e-3, 3e-3, 5e-3}},
          {"radius", 4e-3}}}},
       pi * 16e-6 * std::sqrt(16.0 + 36 + 81) * 1e-3},
      {"turned_box", turned_box(), 240e-9},
      {"box_between_cells", box({0.3e-3, 0.2e-3, -0.6e-3}, {6.7e-3, 5.4e-3, 4.1e-3}),
       6.4 * 5.2 * 4.7 * 1e-9},
      {"block_without_a_ball",
       {{"difference", {box({-5.2e-3, -5.2e-3, -5.2e-3}, {5.2e-3, 5.2e-3, 5.2e-3}), ball(4e-3)}}},
       (std::pow(10.4, 3) - 4 * pi / 3 * 64) * 1e-9},
  };
  return all;
}

TEST(PartialCells, HaveTheVolumeAndMassOfTheShape) {
  for (const Solid& solid : solids()) {
    // Cells with little inside count too, so that the volume is that of the shape.
    const auto plan = plan_of(scene_of(solid.shape, {{"poisson", 0.25}}, {},
                                       {{"least_share", 1e-3}, {"anchor", {0, 0, 0}}}));
    const Model& model = *plan->model;
    double mass = 0;
    for (Particle p = 0; p < model.body.particles; ++p) mass += model.mass(p);
    EXPECT_NEAR(plan->body.volume / solid.volume, 1, 5e-4) << solid.name;
    EXPECT_NEAR(mass, 2500 * plan->body.volume, 1e-12 * mass) << solid.name;
    EXPECT_NEAR(plan->body.mass, mass, 1e-12 * mass) << solid.name;
  }
}

TEST(PartialCells, OfAnStlFileHaveItsVolume) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                     ("hyperlattice_cube_" + std::to_string(::getpid()) + ".stl");
  {
    std::ofstream stl(file);
    stl << "solid cube\n";
    constexpr unsigned sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& s : sides)
      for (const auto& corners : {std::array{s[0], s[1], s[2]}, {s[0], s[2], s[3]}}) {
        stl << "facet normal 0 0 0\nouter loop\n";
        for (const unsigned n : corners)
          stl << "vertex " << ((n & 1U) != 0 ? 5.3 : 0) << ' ' << ((n & 2U) != 0 ? 4.7 : 0) << ' '
              << ((n & 4U) != 0 ? 6.2 : 0) << '\n';
        stl << "endloop\nendfacet\n";
      }
    stl << "endsolid cube\n";
  }
  const auto plan =
      plan_of(scene_of({{"stl", {{"file", file.string()}, {"scale", 1e-3}}}}, {{"poisson", 0.25}},
                       {}, {{"anchor", {0.35e-3, 0.1e-3, -0.2e-3}}, {"least_share", 0.01}}));
  std::filesystem::remove(file);
  EXPECT_NEAR(plan->body.volume / (5.3 * 4.7 * 6.2 * 1e-9), 1, 1e-6);
}

/// The open area of each particle, m2.
std::vector<Vec3> areas(const Model& model, const char* region) {
  const Surfaces surfaces(model.body);
  std::vector<Vec3> all(model.body.particles);
  for (const OpenArea& open : open_areas(model.body, surfaces, *built_in_region(region)))
    all[open.particle] = open.area;
  return all;
}

TEST(PartialCells, PassThePatchTest) {
  for (const Solid& solid : solids()) {
    const auto plan = plan_of(scene_of(solid.shape));
    const Model& model = *plan->model;
    const auto area = areas(model, "surface");
    for (int a = 0; a < 3; ++a)
      for (int b = a; b < 3; ++b) {
        // The strain is so small that the springs are linear to the last bit.
        constexpr double size = 1e-20;
        std::vector<double> u(3 * model.body.particles);
        for (Particle p = 0; p < model.body.particles; ++p) {
          const Vec3 x = model.body.position(p);
          u[3 * p + static_cast<std::size_t>(a)] += size * x[b];
          if (a != b) u[3 * p + static_cast<std::size_t>(b)] += size * x[a];
        }
        // E / (1 + nu) (strain + nu / (1 - 2 nu) trace)
        const double shear = size * 1e10 / 1.25;
        const auto traction = [&](Vec3 n) {
          Vec3 t = a == b ? 0.5 * shear * n : Vec3{};
          t[a] += shear * n[b];
          if (a != b) t[b] += shear * n[a];
          return t;
        };
        double worst = 0;
        const auto found = forces(model, u, {});
        for (Particle p = 0; p < model.body.particles; ++p) {
          const Vec3 outer = traction(area[p]);
          for (std::size_t c = 0; c < 3; ++c)
            worst = std::max(worst, std::abs(found[p][c] + outer[c]));
        }
        EXPECT_LT(worst, 1e-12 * shear * l * l) << solid.name << ' ' << a << b;
      }
  }
}

TEST(PartialCells, ShrinkEvenlyUnderTheSamePressureEverywhere) {
  for (const double poisson : {0.25, 0.45})
    for (const Solid& solid : solids()) {
      constexpr double strain = 1e-20;
      const double pressure = 1e10 / (1 - 2 * poisson) * strain;  // three times the bulk modulus
      const auto plan =
          plan_of(scene_of(solid.shape, {{"poisson", poisson}},
                           stage("loads.pressure", {{"on", "surface"}, {"pressure", pressure}})));
      const Model& model = *plan->model;
      std::vector<double> u(3 * model.body.particles);
      for (Particle p = 0; p < model.body.particles; ++p)
        for (std::size_t c = 0; c < 3; ++c) u[3 * p + c] = -strain * model.body.position(p)[c];
      double worst = 0;
      for (const Force& rest : forces(model, u, {}))
        for (const double component : rest) worst = std::max(worst, std::abs(component));
      EXPECT_LT(worst, 1e-12 * pressure * l * l) << solid.name << ' ' << poisson;
    }
}

TEST(PartialCells, CarryAPressureOnACavityAsTheTrueSurfaceDoes) {
  const auto plan = plan_of(scene_of(solids()[1].shape));
  const auto inner = areas(*plan->model, "inner_surface"),
             outer = areas(*plan->model, "outer_surface");
  double inside = 0, outside = 0;  // three times the volumes within, by the divergence theorem
  for (Particle p = 0; p < plan->model->body.particles; ++p) {
    inside -= dot(inner[p], plan->model->body.position(p));
    outside += dot(outer[p], plan->model->body.position(p));
  }
  EXPECT_NEAR(inside / (4 * pi * std::pow(3e-3, 3)), 1, 0.01);
  EXPECT_NEAR(outside / (4 * pi * std::pow(7.3e-3, 3)), 1, 0.01);
}

TEST(PartialCells, AreStableAtThePlannedStep) {
  for (const Keys& material :
       {Keys{{"poisson", 0.25}}, Keys{{"membrane", "I-m"}, {"poisson", 0.1}}})
    for (const Solid& solid : solids())
      EXPECT_LT(growth(*plan_of(scene_of(solid.shape, material))->model, 0.99), 1000) << solid.name;
}

TEST(PartialCells, BalanceTheirEnergy) {
  const Stages loads = stage("loads.fixed", {{"on", "z_min"}}) +
                       stage("loads.gravity", {{"acceleration", {1, 2, -9.81}}}) +
                       stage("loads.pressure", {{"on", "outer_surface"}, {"pressure", 1e5}});
  for (const Keys& material : {Keys{{"poisson", 0.25}}, Keys{{"poisson", 0.45}},
                               Keys{{"membrane", "I-m"}, {"poisson", 0.1}}}) {
    const auto plan = plan_of(scene_of(solids()[1].shape, material, loads));
    const double coarse = worst_balance(*plan->model, 0.4).largest_error,
                 fine = worst_balance(*plan->model, 0.1).largest_error;
    EXPECT_LT(coarse, 1e-3);
    EXPECT_LT(fine, std::max(1e-13, coarse / 10));
  }
}

/// Two materials with breakable springs, pulled apart.
std::unique_ptr<Plan> breaking(int threads) {
  const Keys failure = {{"failure", {{"type", "failures.elongation"}, {"limit", 1e-6}}}};
  const Json part = {{"half_space", {{"point", {0, 0.6e-3, 0}}, {"normal", {0, 1, 0.3}}}}};
  const Keys second = {
      {"young", 3e10}, {"density", 7000}, {"membrane", "I-m"}, {"poisson", 0.1}, {"region", part}};
  return plan_of(
      scene_of(solids()[2].shape, Keys{{"membrane", "I-m"}, {"poisson", 0.2}} + failure,
               stage("materials.elastic", second + failure) +
                   stage("loads.velocity", {{"on", "z_max"}, {"axes", "z"}, {"value", {0, 0, 4}}}) +
                   stage("loads.fixed", {{"on", "z_min"}})),
      threads);
}

TEST(PartialCells, TakeTheEnergyOfTheSpringsThatAreGone) {
  const auto plan = breaking(2);
  Simulation simulation(*plan->model, 2);
  double worst = 0;
  const double dt = 0.1 * plan->model->step_limit.time_step;
  while (simulation.time() < 8e-6) {
    simulation.step(dt);
    worst = std::max(worst, std::abs(simulation.balance().relative_error()));
  }
  EXPECT_GT(simulation.breakages().size(), 10u);
  EXPECT_LT(worst, 1e-3);
}

TEST(PartialCells, HaveTheSameBitsForAnyNumberOfThreads) {
  const auto result = [](int threads) {
    const auto plan = breaking(threads);
    Simulation simulation(*plan->model, threads);
    simulation.set_damping(0.1);
    for (int n = 0; n < 300; ++n) simulation.step(0.8 * plan->model->step_limit.time_step);
    return std::tuple{simulation.hash(), simulation.breakages().size(),
                      simulation.balance().stored};
  };
  const auto one = result(1);
  EXPECT_GT(std::get<1>(one), 10u);
  EXPECT_EQ(result(2), one);
  EXPECT_EQ(result(3), one);
}

// The cells of two materials are weighed with their shares.
TEST(PartialCells, OfSeveralMaterialsHaveTheMassOfTheirCells) {
  const Json part = {{"half_space", {{"point", {0, 0.6e-3, 0}}, {"normal", {0, 1, 0.3}}}}};
  const auto plan = plan_of(
      scene_of(ball(4.4e-3), {{"poisson", 0.25}},
               stage("materials.elastic",
                     {{"young", 3e10}, {"density", 7000}, {"poisson", 0.25}, {"region", part}})));
  const Model& model = *plan->model;
  double mass = 0, expected = 0;
  for (Particle p = 0; p < model.body.particles; ++p) mass += model.mass(p);
  for (const hyperlattice::Run& run : model.body.cells.runs())
    for (Site cell{run.begin, run.j, run.k}; cell.i < run.end; ++cell.i) {
      const double share = model.body.cells.share_of_cell(cell);
      const Vec3 x = model.body.position(cell) + 0.5 * l * Vec3{1, 1, 1};
      const double beyond = x.y - 0.6e-3 + 0.3 * x.z;
      if (share < 1 && std::abs(beyond) < l) {  // decided by volumes: between the two
        expected += share * (2500 + 7000) / 2 * 1e-9;
        continue;
      }
      expected += share * (beyond <= 0 ? 7000 : 2500) * 1e-9;
    }
  EXPECT_NEAR(mass / expected, 1, 0.03);
  EXPECT_NEAR(plan->body.mass, mass, 1e-12 * mass);
}

TEST(PartialCells, MeetAFloorWithTheirShape) {
  // Nothing of the ball is below its lowest point, though particles are.
  const Stages floor = stage("loads.floor", {{"point", {0, 0, -4.4e-3}}, {"normal", {0, 0, 1}}});
  const auto plan = plan_of(scene_of(ball(4.4e-3), {{"poisson", 0.25}}, floor));
  for (const std::string& warning : plan->model->warnings)
    EXPECT_EQ(warning.find("deep in the floor"), std::string::npos) << warning;
  for (const Force& force :
       forces(*plan->model, std::vector<double>(3 * plan->model->body.particles), {}))
    for (const double component : force) EXPECT_LT(std::abs(component), 1e-9);
  std::vector<double> u(3 * plan->model->body.particles);
  for (Particle p = 0; p < plan->model->body.particles; ++p) u[3 * p + 2] = -0.05e-3;
  double pushed = 0;
  for (const Force& force : forces(*plan->model, u, {})) pushed += force[2];
  EXPECT_GT(pushed, 0);
}

TEST(PartialCells, ThePlanSaysWhatCounts) {
  const auto plan = plan_of(scene_of(ball(4.4e-3)));
  const auto lines = body_lines(plan->body);
  const auto cells = std::find_if(lines.begin(), lines.end(),
                                  [](const auto& line) { return line.first == "cells"; });
  ASSERT_NE(cells, lines.end());
  EXPECT_NE(cells->second.find("share of their volume"), std::string::npos) << cells->second;
}

}  // namespace partial_cells_test
