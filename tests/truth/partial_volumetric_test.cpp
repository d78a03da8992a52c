// Bodies of partial cells with a volumetric energy: exact under homogeneous strain, frequencies
// below the bound by one cell, and steps in time, statics, failure and checkpoints that agree.
#include <contract/scenes.hpp>
#include <model/critical_step.hpp>
#include <numerics/symmetric_eigen.hpp>

#include <support/cells.hpp>
#include <support/rest.hpp>

#include <hyperlattice/volumetric_cell.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace partial_volumetric_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr double l = 1e-3;

/// Calls visit(particle, corner, share) for the eight corners of each cell.
template <class Visit>
void for_corners(const Model& model, const Visit& visit) {
  for (const hyperlattice::Run& run : model.body.cells.runs())
    for (Site cell{run.begin, run.j, run.k}; cell.i < run.end; ++cell.i)
      for (std::int32_t n = 0; n < 8; ++n)
        visit(model.body.at({cell.i + (n & 1), cell.j + (n >> 1 & 1), cell.k + (n >> 2)}),
              static_cast<std::size_t>(n), model.body.cells.share_of_cell(cell));
}

class PartialVolumetric : public testing::TestWithParam<MembraneCase> {};
INSTANTIATE_TEST_SUITE_P(Above, PartialVolumetric, testing::ValuesIn(volumetric),
                         [](const auto& info) { return std::string(info.param.name); });
INSTANTIATE_TEST_SUITE_P(Below, PartialVolumetric, testing::ValuesIn(volumetric_below),
                         [](const auto& info) { return std::string(info.param.name); });

/// A homogeneous stress s pulls the corner a of a cell with the force share s s_a l^2/4.
TEST_P(PartialVolumetric, PatchTestIsExact) {
  double worst_of_all = 0;
  for (const CellShape& shape : cell_shapes()) {
    const auto plan = plan_of(scene_of_partial_cells(random_parts(shape), GetParam().material));
    const Model& model = *plan->model;
    ASSERT_EQ(model.body.cells.count(), shape.cells().size()) << shape.name;
    const MaterialConstants& of = model.materials[0].constants;
    const double c44 = of.base_stiffness / l, c12 = c44 + of.volumetric,
                 scale = std::max(c44, std::abs(of.volumetric));
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = a; b < 3; ++b) {
        // The strain is so small that the springs are linear to the last bit.
        constexpr double size = 1e-20;
        std::vector<double> u(3 * model.body.particles);
        for (Particle p = 0; p < model.body.particles; ++p) {
          const Vec3 x = model.body.position(p);
          u[3 * p + a] += 0.5 * size * x[b];
          u[3 * p + b] += 0.5 * size * x[a];
        }
        std::vector<Force> rest = forces(model, u, {});
        for_corners(model, [&](Particle p, std::size_t n, double share) {
          const double pull = share * l * l / 4 * size;
          for (std::size_t c = 0; c < 3 && a == b; ++c)
            rest[p][c] += pull * (c12 + (c == a ? 2 * c44 : 0)) * corner_sign(n, c);
          if (a == b) return;
          rest[p][a] += pull * c44 * corner_sign(n, b);
          rest[p][b] += pull * c44 * corner_sign(n, a);
        });
        double worst = 0;
        for (const Force& force : rest)
          for (const double component : force)
            worst = std::max(worst, std::abs(component) / (scale * l * l * size));
        EXPECT_LT(worst, 1e-13) << shape.name << ", strain " << a << b;
        worst_of_all = std::max(worst_of_all, worst);
      }
  }
  std::printf("largest force without a traction: %.1e max(C, K_v) l^2 eps\n", worst_of_all);
}

/// Returns the largest omega^2 of a body, from the forces of the kernels on each unit displacement.
double largest_square(const Model& model) {
  const std::size_t numbers = 3 * model.body.particles;
  const auto size_of_matrix = static_cast<Eigen::Index>(numbers);
  Eigen::MatrixXd scaled(size_of_matrix, size_of_matrix);  // M^-1/2 K M^-1/2
  constexpr double size = 1e-20;
  std::vector<double> u(numbers);
  for (std::size_t n = 0; n < numbers; ++n) {
    u[n] = size;
    const std::vector<Force> pull = forces(model, u, {});
    u[n] = 0;
    for (std::size_t m = 0; m < numbers; ++m)
      scaled(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(n)) =
          -pull[m / 3][m % 3] / size / std::sqrt(model.mass(m / 3) * model.mass(n / 3));
  }
  return numerics::SymmetricEigen<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

TEST_P(PartialVolumetric, FrequenciesAreBelowTheBoundByOneCell) {
  for (const CellShape& shape : cell_shapes()) {
    if (shape.cells().size() > 100) continue;  // the largest matrices
    const auto plan = plan_of(scene_of_partial_cells(random_parts(shape), GetParam().material));
    const Model& model = *plan->model;
    const double square = largest_square(model), bound = cell_bound(model),
                 found = std::pow(iterated_frequency(model) / 1.02, 2);
    EXPECT_LT(square, bound * (1 + 1e-12)) << shape.name;
    EXPECT_LT(found, square * (1 + 1e-9)) << shape.name;
    EXPECT_GT(found * 1.02 * 1.02, square) << shape.name;
    EXPECT_LT(square, std::pow(2 / model.step_limit.time_step, 2) * (1 + 1e-9)) << shape.name;
  }
}

/// A part of a cell is the cell, lighter and softer.
TEST_P(PartialVolumetric, OneCellHasTheFrequencyOfTheBoundWhateverItsShare) {
  for (const double part : {0.07, 0.4, 1.0}) {
    const auto plan =
        plan_of(scene_of_partial_cells(box({}, {l, l, part * l}), GetParam().material));
    EXPECT_NEAR(largest_square(*plan->model) / cell_bound(*plan->model), 1, 1e-10);
  }
}

/// Growth of the largest displacement over many steps. The initial noise is so small that the
/// springs stay linear.
double growth(const Model& model, double fraction) {
  Simulation simulation(model, 1);
  const double size = 1e-16;
  simulation.set_displacements(noise(3 * model.body.particles, size, 1), {});
  for (int n = 0; n < 600; ++n) simulation.step(fraction * model.step_limit.time_step);
  return largest(displacements(simulation)) / size;
}

TEST_P(PartialVolumetric, IsStableAtThePlannedStep) {
  const Json part = {{"half_space", {{"point", {2e-3, 0, 0}}, {"normal", {-1, 0.2, 0}}}}};
  const Stages other =
      stage("materials.elastic",
            Keys{{"young", 3e10}, {"density", 700}, {"region", part}} + GetParam().material);
  for (const CellShape& shape : cell_shapes()) {
    const Json parts = random_parts(shape);
    EXPECT_LT(growth(*plan_of(scene_of_partial_cells(parts, GetParam().material))->model, 0.99),
              1000)
        << shape.name;
    if (shape.cells().size() < 30) continue;  // too small for two materials
    EXPECT_LT(
        growth(*plan_of(scene_of_partial_cells(parts, GetParam().material, other))->model, 0.99),
        1000)
        << shape.name << ", two materials";
  }
}

/// A static solver ends where damped steps in time end, at large strains.
TEST(PartialVolumetricBody, StaticsAndStepsComeToTheSameRest) {
  const Stages material = elastic(1e6, {{"poisson", 0.45}}),
               loads = stage("loads.fixed", {{"on", "z_min"}}) +
                       stage("loads.force", {{"on", "z_max"}, {"total", {0.1, 0, 0.4}}});
  const Keys bar = {
      {"spacing", l},
      {"shape", {{"cylinder", {{"start", Vec3{}}, {"end", Vec3{0, 0, 5e-3}}, {"radius", 1.7e-3}}}}},
      {"boundary", "partial_cells"},
      {"anchor", {0, 0, 0}}};
  const AtRest by_steps(
      scene(bar, material + loads + stage("solvers.relaxation", {{"tolerance", 1e-9}}))),
      by_statics(scene(bar, material + loads + to_rest));
  EXPECT_GT(largest(by_statics.u), 0.05 * 5e-3);
  EXPECT_LT(distance(by_steps.u, by_statics.u), 1e-6 * largest(by_statics.u));
}

/// The same body in floats has the forces of doubles, to the digits of floats.
TEST(PartialVolumetricBody, HasTheSameForcesInFloats) {
  const std::string text =
      scene_of_partial_cells(random_parts(cell_shapes()[2]), {{"poisson", 0.45}});
  const auto of = [&](const char* precision) {
    const auto plan = plan_of(SceneBuilder(text).key("precision", precision).text());
    // Displacements that floats hold.
    std::vector<double> u = noise(3 * plan->model->body.particles, 0.02 * l);
    for (double& x : u) x = static_cast<double>(static_cast<float>(x));
    return forces(*plan->model, u, {});
  };
  const std::vector<Force> fine = of("double"), coarse = of("float");
  double size = 0, worst = 0;
  for (std::size_t p = 0; p < fine.size(); ++p)
    for (std::size_t c = 0; c < 3; ++c) {
      size = std::max(size, std::abs(fine[p][c]));
      worst = std::max(worst, std::abs(fine[p][c] - coarse[p][c]));
    }
  EXPECT_LT(worst, 1e-5 * size);
}

/// A ball of two materials that is torn apart along z.
std::unique_ptr<Plan> tearing(int threads, double limit = 2e-6) {
  const Keys failure = {{"failure", {{"type", "failures.elongation"}, {"limit", limit}}}};
  const Json part = {{"half_space", {{"point", {0, 0.6e-3, 0}}, {"normal", {0, 1, 0.3}}}}};
  const Keys second = {{"young", 3e10}, {"density", 7000}, {"poisson", 0.4}, {"region", part}};
  return plan_of(
      scene_of_partial_cells(
          {{"sphere", {{"radius", 4.4e-3}}}}, Keys{{"poisson", 0.45}} + failure,
          stage("materials.elastic", second + failure) +
              stage("loads.velocity", {{"on", "z_max"}, {"axes", "z"}, {"value", {0, 0, 4}}}) +
              stage("loads.fixed", {{"on", "z_min"}})),
      threads);
}

TEST(PartialVolumetricBody, HasTheSameBitsForAnyNumberOfThreadsAndAfterARestart) {
  const auto result = [](int threads, bool is_cut_off) {
    const auto plan = tearing(threads);
    auto simulation = std::make_unique<Simulation>(*plan->model, threads);
    simulation->set_damping(0.1);
    for (int n = 0; n < 400; ++n) {
      simulation->step(0.8 * plan->model->step_limit.time_step);
      if (is_cut_off && n == 300)
        simulation = contract::restarted(*simulation, *plan->model, threads);
    }
    return std::tuple{simulation->hash(), simulation->breakages().size(),
                      simulation->balance().stored};
  };
  const auto one = result(1, false);
  EXPECT_GT(std::get<1>(one), 10U);
  EXPECT_EQ(result(2, false), one);
  EXPECT_EQ(result(3, false), one);
  EXPECT_EQ(result(2, true), one);
}

/// The energy of the springs and cells that are gone is released energy, never below zero, and the
/// balance closes with the square of the step.
TEST(PartialVolumetricBody, TakesTheEnergyOfTheCellsThatAreGone) {
  const auto worst = [](double fraction) {
    const auto plan = tearing(2);
    Simulation simulation(*plan->model, 2);
    const double dt = fraction * plan->model->step_limit.time_step;
    double found = 0, lost = 0;
    while (simulation.time() < 1e-5) {
      simulation.step(dt);
      const EnergyBalance balance = simulation.balance();
      EXPECT_GE(balance.dissipated_failure, lost);
      lost = balance.dissipated_failure;
      found = std::max(found, std::abs(balance.relative_error()));
    }
    EXPECT_GT(simulation.breakages().size(), 10U);
    EXPECT_GT(lost, 0);
    return found;
  };
  const double coarse = worst(0.4), fine = worst(0.1);
  std::printf("balance: %.1e %.1e\n", coarse, fine);
  EXPECT_LT(coarse, 1e-4);
  EXPECT_LT(fine, coarse / 4);
}

/// Each site of a body of partial cells has a modulus of its own.
TEST(PartialVolumetricBody, ThePlanCountsTheModuli) {
  const auto bytes = [](double poisson, const char* boundary) {
    const auto plan = plan_of(SceneBuilder{}
                                  .lattice("lattices.cubic", l, {{"sphere", {{"radius", 6e-3}}}},
                                           {{"boundary", boundary}})
                                  .stages(elastic(1e9, {{"poisson", poisson}}))
                                  .solver("solvers.explicit", {{"end_time", 1e-6}})
                                  .text());
    return plan->bytes_per_particle;
  };
  EXPECT_EQ(bytes(0.45, "cells"), bytes(0.25, "cells"));
  EXPECT_GE(bytes(0.45, "partial_cells"), bytes(0.25, "partial_cells") + 8);
}

}  // namespace partial_volumetric_test
