// The stress of cells and particles: homogeneous deformation of any body of cells, the energy's
// derivatives, forces through layers and at supports, and laws of any kind.
#include <state/cell_stress.hpp>
#include <state/particle_stress.hpp>
#include <support/cells.hpp>
#include <support/lists.hpp>
#include <support/rest.hpp>
#include <support/tensors.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace stress_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr double l = 1e-3;

/// Some of the cells of a cube, chosen at random.
CellShape random_cells() {
  std::mt19937 random(7);
  std::set<CellIndex> cells;
  Json solids = Json::array();
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i)
        if (random() % 2 == 0) {
          cells.insert({i, j, k});
          solids.push_back(box_of_cells({i, j, k}, {i + 1, j + 1, k + 1}));
        }
  return {"random_cells", {{"union", solids}}, [cells](double x, double y, double z) {
            return cells.count({static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)),
                                static_cast<int>(std::floor(z))}) > 0;
          }};
}

std::vector<CellShape> shapes() {
  std::vector<CellShape> all = cell_shapes();
  all.push_back(random_cells());
  return all;
}

/// A deformation with stretches of 20 % and shear of 30 %.
constexpr Tensor large_H{{Vec3{0.2, 0.3, -0.05}, Vec3{0.02, -0.1, 0.1}, Vec3{-0.04, 0.06, 0.15}}};

/// Nominal stress and energy density of the infinite lattice without a membrane, spring by spring.
struct Infinite {
  Tensor nominal;
  double energy = 0;
  Infinite(const Model& model, const Tensor& H) {
    for (const NeighbourGeometry& to : model.springs.neighbours) {
      const double k = model.springs.spring(0, 0, to.site.spring_class).stiffness;
      const Vec3 r = to.rest + H * to.rest;
      const double longer = norm(r) - to.rest_length;
      nominal += k * longer / norm(r) / (l * l * l) * outer(r, to.rest);
      energy += k * longer * longer / 2 / (l * l * l);
    }
  }
  Tensor cauchy(const Tensor& H) const {
    const Tensor F = identity + H;
    return 1 / determinant(F) * (nominal * transposed(F));
  }
};

TEST(Stress, OfALargeHomogeneousDeformationIsExactAtEachParticleOfCells) {
  for (const CellShape& shape : shapes()) {
    const auto plan = plan_of(scene_of_cells(shape.shape, {{"poisson", 0.25}}));
    const Model& model = *plan->model;
    ASSERT_EQ(model.body.cells.count(), shape.cells().size()) << shape.name;
    Simulation simulation(model, 2);
    simulation.set_displacements(linear(model.body, large_H), {});
    const PresentSprings springs(model, simulation);
    const Infinite infinite(model, large_H);
    const Symmetric expected = symmetric_part(infinite.cauchy(large_H));
    const auto stress = cauchy_stresses(springs);
    const auto nominal = nominal_stresses(springs);
    const auto energy = energy_densities(springs);
    for (Particle p = 0; p < model.body.particles; ++p) {
      ASSERT_LT(largest_difference(stress[p], expected), 1e-12 * von_mises(expected))
          << shape.name << " " << p;
      ASSERT_LT(largest_difference(nominal[p], infinite.nominal), 1e-12 * von_mises(expected))
          << shape.name;
      ASSERT_NEAR(energy[p] / infinite.energy, 1, 1e-12) << shape.name;
    }
  }
}

/// C11, C12 and C44 in closed form, and how much the heights sink with the volume (Zhao 2017).
struct Elasticity {
  double c11, c12, c44, relaxation = 0;
  explicit Elasticity(const Model& model) {
    const MaterialConstants& m = model.materials[0].constants;
    const double kb = m.cross_ratio[0], kg = m.cross_ratio[1], ka = m.alpha_ratio;
    const double C3 = ka + 3 * kb + 4 * kg, C4 = kb + 8 * kg / 3;
    if (model.degrees_of_freedom == 4) relaxation = C4 / C3;
    const double unit = m.base_stiffness / (2 * l), taken = relaxation * C4;
    c11 = unit * (6 + kb + 8 * kg / 3 - taken);
    c12 = unit * (2 + 4 * kg / 3 - taken);
    c44 = unit * (2 + 4 * kg / 3);
  }
};

TEST(Stress, OfSmallStrainsIsThatOfTheElasticConstantsForEachMembrane) {
  for (const MembraneCase& membrane : membrane_cases)
    for (const CellShape& shape : {cell_shapes()[2], cell_shapes()[6], random_cells()}) {
      const auto plan = plan_of(scene_of_cells(shape.shape, membrane.material));
      const Model& model = *plan->model;
      const Elasticity of(model);
      const Tensor H{{Vec3{2e-20, 1e-20, 0}, Vec3{0, -1e-20, 3e-20}, Vec3{1e-20, 0, 3e-20}}};
      std::vector<double> heights;
      if (model.degrees_of_freedom == 4)
        heights.assign(model.body.particles,
                       -of.relaxation * trace(H) * model.body.grid.membrane_distance / 2);
      Simulation simulation(model, 1);
      simulation.set_displacements(linear(model.body, H), heights);
      const Symmetric e = symmetric_part(H);
      Symmetric expected{};
      for (std::size_t n = 0; n < 6; ++n)
        expected[n] = n < 3 ? of.c11 * e[n] + of.c12 * (trace(H) - e[n]) : 2 * of.c44 * e[n];
      const auto stress = cauchy_stresses(PresentSprings(model, simulation));
      const double scale = of.c44 * 1e-20;
      for (Particle p = 0; p < model.body.particles; ++p)
        ASSERT_LT(largest_difference(stress[p], expected), 1e-12 * scale)
            << membrane.name << ", " << shape.name << " " << p;
    }
}

TEST(Stress, OfWholeParticlesIsExactWhereTheyHaveACell) {
  const auto plan = plan_of(block(4, 4, 4));
  Simulation simulation(*plan->model, 1);
  simulation.set_displacements(linear(plan->model->body, large_H), {});
  const Symmetric expected = symmetric_part(Infinite(*plan->model, large_H).cauchy(large_H));
  for (const Symmetric& stress : cauchy_stresses(PresentSprings(*plan->model, simulation)))
    ASSERT_LT(largest_difference(stress, expected), 1e-12 * von_mises(expected));

  const auto thin = plan_of(block(4, 4, 1));
  Simulation plate(*thin->model, 1);
  for (const Symmetric& stress : cauchy_stresses(PresentSprings(*thin->model, plate)))
    EXPECT_TRUE(std::isnan(stress[0]));
}

/// One cell in a random motion. The nominal stress is the derivative of its energy.
TEST(Stress, IsTheDerivativeOfTheEnergyOfACell) {
  for (const char* material :
       {R"("poisson": 0.25)", R"("poisson": 0.45)", R"("membrane": "I-m", "poisson": 0.1)",
        R"("membrane": "II", "poisson": 0.1)"}) {
    const auto plan = plan_of(scene_of_cells(box_of_cells({0, 0, 0}, {1, 1, 1}), material));
    const Model& model = *plan->model;
    const auto start = noise(24, 0.15 * l);
    const auto heights =
        model.degrees_of_freedom == 4 ? noise(8, 0.05 * l, 3) : std::vector<double>{};
    /// Returns the cell after a further motion H x.
    const auto cell_at = [&](const Tensor& H) {
      std::vector<double> u = start;
      const auto more = linear(model.body, H);
      for (std::size_t n = 0; n < u.size(); ++n) u[n] += more[n];
      Simulation simulation(model, 1);
      simulation.set_displacements(u, heights);
      PresentCell found;
      for_cells(PresentSprings(model, simulation), Asked::energies,
                [&](const PresentCell& cell) { found = cell; });
      EXPECT_NEAR(found.energy / simulation.balance().stored, 1, 1e-12);
      return found;
    };
    const auto energy = [&](const Tensor& H) { return energy_density(cell_at(H), l); };
    const PresentCell cell = cell_at({});
    const Tensor P = nominal_stress(cell, l), sigma = *cauchy_stress(cell, l);
    const double J = 1 + volume_change(cell.gradient);
    EXPECT_NEAR(J, determinant(identity + cell.gradient), 1e-12);
    Tensor differences;
    constexpr double h = 1e-6;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        Tensor H;
        H[i][j] = h;
        differences[i][j] = (energy(H) - energy(-1 * H)) / (2 * h);
      }
    double scale = 0;
    for (std::size_t i = 0; i < 3; ++i) scale = std::max(scale, norm(P[i]));
    EXPECT_LT(largest_difference(P, differences), 1e-8 * scale) << material;
    EXPECT_LT(largest_difference(sigma, transposed(sigma)), 1e-13 * scale) << material;
    Tensor of_places;
    for (std::size_t n = 0; n < 8; ++n) {
      const Vec3 X{corner_sign(n, 0), corner_sign(n, 1), corner_sign(n, 2)};
      of_places += -1 / (J * l * l * l) * outer(cell.force[n], 0.5 * l * X + cell.moved[n]);
    }
    EXPECT_LT(largest_difference(sigma, of_places), 1e-12 * scale) << material;
  }
}

/// sum P_i V_i = -sum f (x) X over all particles, whatever the motion.
TEST(Stress, SumsToTheVirialOfTheForces) {
  for (const CellShape& shape : shapes()) {
    const auto plan = plan_of(scene_of_cells(shape.shape, R"("membrane": "I-m", "poisson": 0.1)"));
    const Model& model = *plan->model;
    Simulation simulation(model, 3);
    simulation.set_displacements(noise(3 * model.body.particles, 0.05 * l),
                                 noise(model.body.particles, 0.02 * l, 5));
    const PresentSprings springs(model, simulation);
    const auto nominal = nominal_stresses(springs);
    const auto forces = internal_forces(springs);
    Tensor left, right;
    double scale = 0;
    for (Particle p = 0; p < model.body.particles; ++p) {
      left += model.body.share(p) * l * l * l * nominal[p];
      right += -1 * outer(forces[p], model.body.position(p));
      scale = std::max(scale, norm(forces[p]) * l);
    }
    EXPECT_LT(largest_difference(left, right),
              1e-13 * scale * static_cast<double>(model.body.particles))
        << shape.name;
  }
}

/// A clamped bar of cells, pulled: through each layer goes the reaction at the end.
TEST(Stress, ThroughEachLayerGoesTheReaction) {
  const AtRest bar(
      SceneBuilder{}
          .lattice("lattices.cubic", l, box_of_cells({0, 0, 0}, {4, 3, 8}), {{"boundary", "cells"}})
          .material("materials.elastic", {{"young", 1e10}, {"density", 2500}, {"poisson", 0.25}})
          .load("loads.fixed", {{"on", "z_min"}})
          .load("loads.displacement",
                {{"on", "z_max"}, {"value", Vec3{0, 0, 1e-4}}, {"rise", 1e-6}})
          .solver("solvers.static", {{"tolerance", 1e-12}})
          .text());
  std::vector<Vec3> through(8);
  const PresentSprings springs(bar.model(), *bar.simulation);
  for_cells(springs, Asked::forces, [&](const PresentCell& cell) {
    const Tensor P = nominal_stress(cell, l);
    through[static_cast<std::size_t>(cell.site.k)] += l * l * Vec3{P[0].z, P[1].z, P[2].z};
  });
  const std::vector<Vec3> reactions = bar.simulation->force_on_load();
  ASSERT_GT(reactions[0].z, 100);
  for (const Vec3& force : through) EXPECT_LT(norm(force - reactions[0]), 1e-11 * reactions[0].z);
}

TEST(Stress, HasTheSameBitsForAnyNumberOfThreads) {
  for (const char* lattice : {"lattices.cubic", "lattices.bcc", "lattices.random"}) {
    const auto plan = plan_of(block(6, 5, 7, Keys(R"("membrane": "none")"), {}, lattice), 3);
    std::vector<Symmetric> first;
    std::vector<double> first_energies;
    for (const int threads : {1, 2, 3}) {
      Simulation simulation(*plan->model, threads);
      simulation.set_displacements(noise(3 * plan->model->body.particles, 0.05 * l), {});
      const PresentSprings springs(*plan->model, simulation);
      const auto stress = cauchy_stresses(springs);
      const auto energies = energy_densities(springs);
      if (threads == 1) {
        first = stress;
        first_energies = energies;
      }
      EXPECT_EQ(stress, first) << lattice;
      EXPECT_EQ(energies, first_energies) << lattice;
    }
  }
}

/// The forces on all particles in their present state, through the kernels.
std::vector<Vec3> forces_of_kernels(const Model& model, const std::vector<double>& u,
                                    const std::vector<double>& heights) {
  std::vector<Vec3> found;
  for (const Force& force : forces(model, u, heights))
    found.push_back({force[0], force[1], force[2]});
  return found;
}

TEST(InternalForce, IsThatOfTheKernels) {
  const std::vector<std::string> scenes{
      block(5, 4, 3),
      block(5, 4, 3, membrane_cases[6]),
      block(5, 4, 3, centred_lattices[0]),
      block(5, 4, 3, centred_lattices[4]),
      block(5, 4, 3, Keys(R"("membrane": "none")"), {}, "lattices.random"),
      scene_of_cells(cell_shapes()[2].shape, membrane_cases[6].material)};
  for (const std::string& scene : scenes) {
    const auto plan = plan_of(scene);
    const Model& model = *plan->model;
    const auto u = noise(3 * model.body.particles, 0.02 * l);
    const auto heights = model.degrees_of_freedom == 4 ? noise(model.body.particles, 0.01 * l, 9)
                                                       : std::vector<double>{};
    Simulation simulation(model, 2);
    simulation.set_displacements(u, heights);
    const auto found = internal_forces(PresentSprings(model, simulation));
    const auto expected = forces_of_kernels(model, u, heights);
    double scale = 0;
    for (const Vec3& force : expected) scale = std::max(scale, norm(force));
    for (Particle p = 0; p < model.body.particles; ++p)
      ASSERT_LT(norm(found[p] - expected[p]), 1e-12 * scale) << scene;
  }
}

/// A bar of cells held along z only, so that its stress is uniaxial.
SceneBuilder bar(const Stages& materials, const Keys& lattice = {{"boundary", "cells"}}) {
  return SceneBuilder{}
      .lattice("lattices.cubic", l, box_of_cells({0, 0, 0}, {3, 3, 6}), lattice)
      .stages(materials)
      .load("loads.fixed", {{"on", "z_min"}, {"axes", "z"}, {"name", "foot"}})
      .load("loads.displacement", {{"on", "z_max"},
                                   {"axes", "z"},
                                   {"value", Vec3{0, 0, 2e-5}},
                                   {"rise", 1e-6},
                                   {"name", "head"}})
      .solver("solvers.static", {{"tolerance", 1e-11}});
}

Stages of(const std::string& law, const Keys& more) {
  return stage("materials." + law,
               Keys{{"young", 1e10}, {"density", 2500}, {"membrane", "none"}} + more);
}

double reaction(const AtRest& body) {
  for (const Vec3& force : body.simulation->force_on_load())
    if (force.z != 0) return std::abs(force.z);
  return 0;
}

TEST(Stress, OfABarIsTheForceOverTheAreaForEveryLaw) {
  const Keys upper = {{"region", box_of_cells({-1, -1, 3}, {9, 9, 9})}};
  const std::vector<std::pair<const char*, Stages>> cases{
      {"elastic", of("elastic", {})},
      {"plastic", of("plastic", {{"yield", 2e7}, {"hardening", 0.1}})},
      {"two elastic", of("elastic", {}) + of("elastic", Keys{{"young", 3e10}} + upper)},
      {"two laws", of("elastic", {{"young", 3e10}}) +
                       of("plastic", Keys{{"yield", 2e7}, {"hardening", 0.1}} + upper)}};
  for (const auto& [name, materials] : cases) {
    const AtRest body(bar(materials).text());
    const PresentSprings springs(body.model(), *body.simulation);
    const double force = reaction(body), area = 9 * l * l;
    ASSERT_GT(force, 1) << name;
    std::vector<double> through(6, 0);
    for_cells(springs, Asked::energies, [&](const PresentCell& cell) {
      through[static_cast<std::size_t>(cell.site.k)] += l * l * nominal_stress(cell, l)[2].z;
    });
    for (const double of_layer : through) EXPECT_NEAR(of_layer / force, 1, 1e-8) << name;
    if (materials.json().size() > 1) continue;
    const auto nominal = nominal_stresses(springs);
    for (Particle p = 0; p < body.model().body.particles; ++p)
      ASSERT_NEAR(nominal[p][2].z * area / force, 1, 1e-8) << name;
  }
}

TEST(Stress, IsGoneWithTheSprings) {
  const auto plan = plan_of(
      block(3, 3, 3,
            {{"poisson", 0.25}, {"failure", {{"type", "failures.elongation"}, {"limit", 1e-6}}}}));
  Simulation simulation(*plan->model, 2);
  const Tensor H{{Vec3{0.01, 0, 0}, Vec3{0, 0.01, 0}, Vec3{0, 0, 0.01}}};
  simulation.set_displacements(linear(plan->model->body, H), {});
  EXPECT_GT(cauchy_stresses(PresentSprings(*plan->model, simulation))[0][0], 1e6);
  simulation.step(1e-9);
  EXPECT_EQ(simulation.broken(), plan->model->body.base_springs());
  const PresentSprings springs(*plan->model, simulation);
  for (const Symmetric& stress : cauchy_stresses(springs)) EXPECT_EQ(stress, Symmetric{});
  for (const Tensor& gradient : gradients(springs, springs.displacements()))
    EXPECT_TRUE(std::isnan(gradient[0].x));
}

TEST(Stress, VonMisesAndPressure) {
  EXPECT_DOUBLE_EQ(von_mises({3, 0, 0, 0, 0, 0}), 3);
  EXPECT_DOUBLE_EQ(von_mises({0, 0, 0, 0, 2, 0}), 2 * std::sqrt(3));
  EXPECT_EQ(von_mises({5, 5, 5, 0, 0, 0}), 0);
  EXPECT_DOUBLE_EQ(pressure({-1, -2, -6, 4, 4, 4}), 3);
  const Principal of = principal({1, 2, 3, 0, 0, 0});
  EXPECT_EQ(of.values, (Vec3{3, 2, 1}));
  EXPECT_EQ(of.directions[0], (Vec3{0, 0, 1}));
  // The order xx yy zz yz xz xy: a shear in the plane xy pulls along (1, 1, 0).
  const Symmetric shear = symmetric_part({{Vec3{0, 2, 0}, Vec3{}, Vec3{}}});
  EXPECT_EQ(shear, (Symmetric{0, 0, 0, 0, 0, 1}));
  EXPECT_NEAR(norm(principal(shear).directions[0] - Vec3{1, 1, 0} / std::sqrt(2.0)), 0, 1e-15);
}

}  // namespace stress_test
