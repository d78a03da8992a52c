// Loads on bodies of cells: exact resultants, and exact equilibrium of the springs with a pressure
// that is the same everywhere.
#include <support/cells.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cells_loads_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

std::unique_ptr<Plan> box_with(const Stages& loads) {
  return plan_of(scene_of_cells(box_mm(3, 4, 5), {{"poisson", 0.25}}, loads));
}

Vec3 resultant(const Load& load) {
  Vec3 sum;
  for (const LoadedParticle& loaded : load.particles) sum = sum + loaded.force;
  return sum;
}

void expect_near(Vec3 found, Vec3 expected, double tolerance) {
  EXPECT_NEAR(found.x, expected.x, tolerance);
  EXPECT_NEAR(found.y, expected.y, tolerance);
  EXPECT_NEAR(found.z, expected.z, tolerance);
}

TEST(CellLoads, PressureIsAQuarterOfAFaceOnEachOfItsCorners) {
  const auto plan = box_with(stage("loads.pressure", {{"on", "x_max"}, {"pressure", 7e6}}));
  const Load& load = plan->model->loads[0];
  EXPECT_EQ(load.particles.size(), 30u);
  expect_near(resultant(load), {-7 * 20, 0, 0}, 1e-12);
  for (const LoadedParticle& loaded : load.particles) {
    const CellIndex at = corner_of(*plan->model, loaded.particle);
    const int quarters = (at[1] % 4 == 0 ? 1 : 2) * (at[2] % 5 == 0 ? 1 : 2);
    expect_near(loaded.force, {-7.0 / 4 * quarters, 0, 0}, 1e-14);
  }
}

TEST(CellLoads, AForceInTotalStressesAFaceEvenly) {
  const auto plan = box_with(stage("loads.force", {{"on", "x_max"}, {"total", {-140, 0, 0}}}) +
                             stage("loads.pressure", {{"on", "x_max"}, {"pressure", 7e6}}));
  const auto &force = plan->model->loads[0].particles, &pressure = plan->model->loads[1].particles;
  ASSERT_EQ(force.size(), pressure.size());
  for (std::size_t n = 0; n < force.size(); ++n)
    expect_near(force[n].force, pressure[n].force, 1e-13);
}

TEST(CellLoads, BlastIsRadialAndHasTheTrueArea) {
  const auto plan = plan_of(scene_of_cells(
      {{"hollow_sphere", {{"inner_radius", 8e-3}, {"outer_radius", 15e-3}}}}, {{"poisson", 0.25}},
      stage("loads.blast",
            {{"on", "inner_surface"}, {"peak", 2e6}, {"rise", 1e-6}, {"fall", 3e-6}})));
  const Load& load = plan->model->loads[0];
  double radial = 0;
  for (const LoadedParticle& loaded : load.particles) {
    const Vec3 at = plan->model->body.position(loaded.particle);
    EXPECT_LT(norm(cross(at, loaded.force)), 1e-12 * norm(at) * norm(loaded.force));
    EXPECT_GT(dot(at, loaded.force), 0);
    radial += norm(loaded.force);
  }
  const double area = 4 * std::numbers::pi * 64e-6;
  EXPECT_NEAR(radial, 2e6 * area, 1e-9 * 2e6 * area);
  expect_near(resultant(load), {}, 1e-10 * radial);
}

TEST(CellLoads, GravityPullsTheMassOfTheVolume) {
  const auto plan = box_with(stage("loads.gravity", {{"acceleration", {0, 0, -10}}}));
  const std::size_t n = plan->model->body.particles;
  double sum = 0;
  for (const Force& force : forces(*plan->model, std::vector<double>(3 * n, 0), {}))
    sum += force[2];
  EXPECT_NEAR(sum, -2500 * 60e-9 * 10, 1e-14);
}

class PressedCells : public testing::TestWithParam<MembraneCase> {};
INSTANTIATE_TEST_SUITE_P(Membranes, PressedCells, testing::ValuesIn(membrane_cases),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_P(PressedCells, ShrinkEvenlyUnderTheSamePressureEverywhere) {
  for (const CellShape& shape : cell_shapes()) {
    constexpr double strain = 1e-20, l = 1e-3;  // linear to the last bit
    const auto scene = [&](double pressure) {
      return plan_of(
          scene_of_cells(shape.shape, GetParam().material,
                         stage("loads.pressure", {{"on", "surface"}, {"pressure", pressure}})));
    };
    const MaterialConstants m = scene(1)->model->materials[0].constants;
    const double kb = m.cross_ratio[0], kg = m.cross_ratio[1];
    const bool free = !m.clamped && m.has_cross_springs();
    const double C1 = 6 + kb + 8 * kg / 3, C2 = 2 + 4 * kg / 3,
                 C3 = m.alpha_ratio + 3 * kb + 4 * kg, C4 = kb + 8 * kg / 3;
    const double relaxation = free ? C4 / C3 : 0;
    const auto plan =
        scene(m.base_stiffness / (2 * l) * (C1 + 2 * C2 - 3 * relaxation * C4) * strain);
    const Model& model = *plan->model;
    std::vector<double> u(3 * model.body.particles), heights;
    for (Particle p = 0; p < model.body.particles; ++p)
      for (std::size_t c = 0; c < 3; ++c) u[3 * p + c] = -strain * corner_of(model, p)[c] * l;
    if (free) heights.assign(model.body.particles, relaxation * 3 * strain * l / 2);
    double worst = 0;
    for (const Force& rest : forces(model, u, heights))
      for (const double component : rest) worst = std::max(worst, std::abs(component));
    EXPECT_LT(worst, 1e-12 * m.base_stiffness * strain * l) << shape.name;
  }
}

}  // namespace cells_loads_test
