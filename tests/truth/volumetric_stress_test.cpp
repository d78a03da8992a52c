// Stress, energy density and forces of bodies with the volumetric energy of cells: homogeneous
// deformation is exact at every particle, whole cells and parts alike; cells that are inside out or
// lost their energy.
#include <state/cell_stress.hpp>
#include <state/particle_stress.hpp>

#include <support/cells.hpp>
#include <support/laws.hpp>
#include <support/tensors.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace volumetric_stress_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr double l = 1e-3;

/// Largest difference of two tensors; infinite if a number is none.
template <std::size_t rows, class Row>
double distance_of(const std::array<Row, rows>& a, const std::array<Row, rows>& b) {
  double most = 0;
  for (std::size_t n = 0; n < rows; ++n) {
    const double apart = [&] {
      if constexpr (std::is_same_v<Row, Vec3>)
        return norm(a[n] - b[n]);
      else
        return std::abs(a[n] - b[n]);
    }();
    most = std::isnan(apart) ? HUGE_VAL : std::max(most, apart);
  }
  return most;
}
double distance_of(const Tensor& a, const Tensor& b) { return distance_of(a.rows, b.rows); }

/// A deformation with stretches of 20 % and shear of 30 %.
constexpr Tensor large_H{{Vec3{0.2, 0.3, -0.05}, Vec3{0.02, -0.1, 0.1}, Vec3{-0.04, 0.06, 0.15}}};

/// Nominal stress and energy density of the infinite lattice: spring by spring, and of U(J) =
/// 9/2 K_v (J^(1/3) - 1)^2.
struct Infinite {
  Tensor nominal;
  double energy = 0;
  Infinite(const Model& model, const Tensor& H) {
    const Tensor F = identity + H;
    for (const NeighbourGeometry& to : model.springs.neighbours) {
      const double k = model.springs.spring(0, 0, to.site.spring_class).stiffness;
      const Vec3 r = F * to.rest;
      const double longer = norm(r) - to.rest_length;
      nominal += k * longer / norm(r) / (l * l * l) * outer(r, to.rest);
      energy += k * longer * longer / 2 / (l * l * l);
    }
    const double K = model.materials[0].constants.volumetric, J = determinant(F);
    nominal += 3 * K * (std::cbrt(J) - 1) / std::pow(std::cbrt(J), 2) * cofactor(F);
    energy += 4.5 * K * std::pow(std::cbrt(J) - 1, 2);
  }
  Symmetric cauchy(const Tensor& H) const {
    const Tensor F = identity + H;
    return symmetric_part(1 / determinant(F) * (nominal * transposed(F)));
  }
};

TEST(VolumetricStress, OfALargeHomogeneousDeformationIsExactAtEachParticle) {
  for (const MembraneCase& of : volumetric) {
    std::vector<std::string> scenes{block(4, 5, 3, of)};
    for (const CellShape& shape : cell_shapes()) {
      scenes.push_back(scene_of_cells(shape.shape, of.material));
      scenes.push_back(scene_of_partial_cells(random_parts(shape), of.material));
    }
    for (const std::string& scene : scenes) {
      const auto plan = plan_of(scene);
      const Model& model = *plan->model;
      Simulation simulation(model, 2);
      simulation.set_displacements(linear(model.body, large_H), {});
      const PresentSprings springs(model, simulation);
      const Infinite infinite(model, large_H);
      const Symmetric expected = infinite.cauchy(large_H);
      double scale = 0;
      for (const double component : expected) scale = std::max(scale, std::abs(component));
      const auto stress = cauchy_stresses(springs);
      const auto nominal = nominal_stresses(springs);
      const auto energy = energy_densities(springs);
      for (Particle p = 0; p < model.body.particles; ++p) {
        ASSERT_LT(distance_of(stress[p], expected), 1e-12 * scale) << of.name << " " << scene;
        ASSERT_LT(distance_of(nominal[p], infinite.nominal), 1e-12 * scale) << of.name;
        ASSERT_NEAR(energy[p] / infinite.energy, 1, 1e-12) << of.name;
      }
    }
  }
}

/// sum P_i V_i = -sum f (x) X over all particles, whatever the motion; and these forces are those
/// of the kernels.
TEST(VolumetricStress, SumsToTheVirialOfTheForces) {
  for (const CellShape& shape : cell_shapes()) {
    const auto plan = plan_of(scene_of_partial_cells(random_parts(shape), {{"poisson", 0.45}}));
    const Model& model = *plan->model;
    const auto u = noise(3 * model.body.particles, 0.02 * l);
    Simulation simulation(model, 3);
    simulation.set_displacements(u, {});
    const PresentSprings springs(model, simulation);
    const auto nominal = nominal_stresses(springs);
    const auto energy = energy_densities(springs);
    const auto own = internal_forces(springs);
    const auto of_kernels = forces(model, u, {});
    Tensor left, right;
    double scale = 0, worst = 0, stored = 0;
    for (Particle p = 0; p < model.body.particles; ++p) {
      const double volume = model.body.share(p) * l * l * l;
      left += volume * nominal[p];
      stored += volume * energy[p];
      right += -1 * outer(own[p], model.body.position(p));
      scale = std::max(scale, norm(own[p]));
      worst = std::max(worst,
                       norm(own[p] - Vec3{of_kernels[p][0], of_kernels[p][1], of_kernels[p][2]}));
    }
    EXPECT_LT(worst, 1e-12 * scale) << shape.name;
    EXPECT_LT(distance_of(left, right),
              1e-13 * scale * l * static_cast<double>(model.body.particles))
        << shape.name;
    EXPECT_NEAR(stored / simulation.balance().stored, 1, 1e-12) << shape.name;
  }
}

/// A cell with J <= 0 has no Cauchy stress, because it has no volume to refer a force to. Its
/// nominal stress and its energy refer to the volume at rest.
TEST(VolumetricStress, ACellThatIsInsideOutHasNoCauchyStress) {
  for (const char* material : {R"("poisson": 0.25)", R"("poisson": 0.45)"}) {
    const auto plan = plan_of(scene_of_cells(box_mm(2, 1, 1), material));
    const Model& model = *plan->model;
    Simulation simulation(model, 1);
    std::vector<double> u(3 * model.body.particles);
    const auto is_pushed = [&](Particle p) { return corner_of(model, p)[0] == 2; };
    for (Particle p = 0; p < model.body.particles; ++p)
      if (is_pushed(p)) u[3 * p] = -1.5 * l;  // through the middle plane: J = -1/2
    simulation.set_displacements(u, {});
    const PresentSprings springs(model, simulation);
    const auto stress = cauchy_stresses(springs);
    const auto nominal = nominal_stresses(springs);
    const auto energy = energy_densities(springs);
    for (Particle p = 0; p < model.body.particles; ++p) {
      EXPECT_EQ(std::isnan(stress[p][0]), is_pushed(p)) << material;
      EXPECT_TRUE(std::isfinite(nominal[p][0].x)) << material;
      EXPECT_TRUE(std::isfinite(energy[p])) << material;
    }
  }
}

/// A spring whose integrity became 0 stays, but takes their energy from its cells: stress and
/// forces are those of the next step.
TEST(VolumetricStress, OfCellsWithASoftenedSpringHasNoVolumetricPart) {
  const auto plan = plan_of(law_scene(
      stage("lattices.cubic", {{"spacing", l}, {"shape", box_mm(4, 4, 5)}, {"boundary", "cells"}}),
      Keys{{"type", "materials.softening"},
           {"membrane", "none"},
           {"poisson", 0.45},
           {"strength", 3e6},
           {"fracture_energy", 5}}));
  const Model& model = *plan->model;
  Simulation simulation(model, 2);
  // The springs through the middle plane are stretched until nothing is left of them.
  std::vector<double> u = noise(3 * model.body.particles, 1e-5 * l);
  for (Particle p = 0; p < model.body.particles; ++p)
    if (corner_of(model, p)[2] >= 3) u[3 * p + 2] += 0.05 * l;
  simulation.set_displacements(u, {});
  const double dt = 1e-3 * model.step_limit.time_step;
  for (int n = 0; n < 3; ++n) simulation.step(dt);
  ASSERT_GT(simulation.breakages().size(), 0U);
  ASSERT_EQ(removed_springs(simulation), 0U);
  const auto internal = internal_forces(PresentSprings(model, simulation));
  std::vector<double> before, after;
  simulation.velocities(before);
  simulation.step(dt);
  simulation.velocities(after);
  double size = 0, worst = 0;
  for (Particle p = 0; p < model.body.particles; ++p)
    for (std::size_t c = 0; c < 3; ++c) {
      const double kick = model.mass(p) * (after[3 * p + c] - before[3 * p + c]) / dt;
      size = std::max(size, std::abs(kick));
      worst = std::max(worst, std::abs(kick - internal[p][c]));
    }
  EXPECT_GT(size, 0);
  EXPECT_LT(worst, 1e-9 * size);
}

}  // namespace volumetric_stress_test
