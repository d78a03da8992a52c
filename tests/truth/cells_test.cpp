// A body of cells is exactly the union of its cells. Under a homogeneous strain, each surface needs
// the tractions of the continuum, and no force acts inside. In large motions the forces are those
// of the springs of each cell and of its volumetric energy, summed cell by cell.
#include <engine/stage_calls.hpp>

#include <support/cells.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace cells_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr double l = 1e-3;

/// Elastic constants of the infinite lattice in closed form (Zhao 2017, equations (27) to (30)),
/// and the change of the height with the strain.
struct Elasticity {
  double c11, c12, c44, relaxation = 0;

  explicit Elasticity(const Model& model) {
    const MaterialConstants& m = model.materials[0].constants;
    const double kb = m.cross_ratio[0], kg = m.cross_ratio[1], ka = m.alpha_ratio;
    const double C1 = 6 + kb + 8 * kg / 3, C2 = 2 + 4 * kg / 3, C3 = ka + 3 * kb + 4 * kg,
                 C4 = kb + 8 * kg / 3;
    if (model.degrees_of_freedom == 4) relaxation = C4 / C3;
    const double unit = m.base_stiffness / (2 * l), taken = relaxation * C4;
    c11 = unit * (C1 - taken) + m.volumetric;
    c12 = unit * (C2 - taken) + m.volumetric;
    c44 = unit * C2;
  }
  using Tensor = std::array<std::array<double, 3>, 3>;
  Tensor stress(const Tensor& e) const {
    Tensor s{};
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b)
        s[a][b] = a == b ? c11 * e[a][a] + c12 * (e[0][0] + e[1][1] + e[2][2] - e[a][a])
                         : 2 * c44 * e[a][b];
    return s;
  }
};

/// The outer force on each corner under uniform stress: a quarter of the traction on each free
/// face. In a free membrane the heights need a force as well: a cell sheared by e in the plane of a
/// face's diagonals pushes its corners up and down in turn, by k_gamma e l / 3. These forces cancel
/// around a corner inside the body or on its faces. At edges a part remains, and only a change of
/// the heights there can balance this part.
std::map<CellIndex, Force> tractions(const CellShape& shape, const Elasticity::Tensor& stress,
                                     const Elasticity::Tensor& push) {
  std::map<CellIndex, Force> all;
  for (const CellIndex& cell : shape.cells()) {
    for (int n = 0; n < 8; ++n)
      for (int a = 0; a < 3; ++a)
        for (int b = a + 1; b < 3; ++b) {
          const bool alike = (n >> a & 1) == (n >> b & 1);
          all[{cell[0] + (n & 1), cell[1] + (n >> 1 & 1), cell[2] + (n >> 2)}][3] +=
              (alike ? 1 : -1) * push[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] *
              l / 3;
        }
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        CellIndex beyond = cell;
        beyond[axis] += 2 * side - 1;
        if (shape.holds(beyond[0] + 0.5, beyond[1] + 0.5, beyond[2] + 0.5)) continue;
        for (int n = 0; n < 4; ++n) {
          CellIndex corner = cell;
          corner[axis] += side;
          corner[(axis + 1) % 3] += n & 1;
          corner[(axis + 2) % 3] += n >> 1;
          for (std::size_t c = 0; c < 3; ++c)
            all[corner][c] += (2 * side - 1) * stress[c][axis] * l * l / 4;
        }
      }
  }
  return all;
}

class CellsOfMembrane : public testing::TestWithParam<MembraneCase> {};
INSTANTIATE_TEST_SUITE_P(Membranes, CellsOfMembrane, testing::ValuesIn(membrane_cases),
                         [](const auto& info) { return std::string(info.param.name); });
INSTANTIATE_TEST_SUITE_P(Volumetric, CellsOfMembrane, testing::ValuesIn(volumetric),
                         [](const auto& info) { return std::string(info.param.name); });
INSTANTIATE_TEST_SUITE_P(VolumetricBelow, CellsOfMembrane, testing::ValuesIn(volumetric_below),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_P(CellsOfMembrane, PatchTestIsExact) {
  double worst_of_all = 0;
  for (const CellShape& shape : cell_shapes()) {
    const auto plan = plan_of(scene_of_cells(shape.shape, GetParam().material));
    const Model& model = *plan->model;
    const Elasticity elasticity(model);
    ASSERT_EQ(model.body.cells.count(), shape.cells().size()) << shape.name;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = a; b < 3; ++b) {
        // The strain is so small that the springs are linear to the last bit.
        Elasticity::Tensor strain{};
        strain[a][b] = strain[b][a] = 1e-20;
        std::vector<double> u(3 * model.body.particles);
        for (Particle p = 0; p < model.body.particles; ++p) {
          const CellIndex x = corner_of(model, p);
          for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t d = 0; d < 3; ++d) u[3 * p + c] += strain[c][d] * x[d] * l;
        }
        std::vector<double> heights;
        if (model.degrees_of_freedom == 4) {
          const double trace = strain[0][0] + strain[1][1] + strain[2][2];
          heights.assign(model.body.particles,
                         -elasticity.relaxation * trace * model.body.grid.membrane_distance / 2);
        }
        const auto found = forces(model, u, heights);
        Elasticity::Tensor push{};
        if (model.degrees_of_freedom == 4)
          push[a][b] = model.springs.spring(0, 0, 1).cross_stiffness * strain[a][b];
        auto expected = tractions(shape, elasticity.stress(strain), push);
        const double scale =
            std::max(model.materials[0].constants.base_stiffness, elasticity.c12 * l) * 1e-20 * l;
        double worst = 0;
        for (Particle p = 0; p < model.body.particles; ++p) {
          const Force& outer = expected[corner_of(model, p)];
          for (std::size_t c = 0; c < 4; ++c)
            worst = std::max(worst, std::abs(found[p][c] + outer[c]) / scale);
        }
        EXPECT_LT(worst, 1e-12) << shape.name << ", strain " << a << b;
        worst_of_all = std::max(worst_of_all, worst);
      }
  }
  std::printf("largest force without a traction: %.1e k eps l\n", worst_of_all);
}

/// Adds the forces of a cell's volumetric energy, from the places of its corners: with the columns
/// F of the mean deformation gradient, p = 3 K_v (J^(-1/3) - J^(-2/3)) acts on their cross
/// products.
template <class Place>
void add_volumetric(const CellIndex& cell, double K_v,
                    const std::map<CellIndex, Particle>& particles, const Place& place,
                    std::vector<Force>& all) {
  if (K_v == 0) return;
  const auto sign = [](int corner, int axis) { return (corner >> axis & 1) != 0 ? 1.0 : -1.0; };
  Vec3 F[3];
  Particle corners[8];
  for (int n = 0; n < 8; ++n) {
    corners[n] = particles.at({cell[0] + (n & 1), cell[1] + (n >> 1 & 1), cell[2] + (n >> 2)});
    const auto at = place(corners[n]);
    for (int d = 0; d < 3; ++d) F[d] += sign(n, d) / (4 * l) * Vec3{at[0], at[1], at[2]};
  }
  const double J = dot(F[0], cross(F[1], F[2])),
               p = 3 * K_v * (std::pow(J, -1.0 / 3) - std::pow(J, -2.0 / 3));
  const Vec3 faces[3] = {cross(F[1], F[2]), cross(F[2], F[0]), cross(F[0], F[1])};
  for (int n = 0; n < 8; ++n)
    for (int d = 0; d < 3; ++d)
      for (std::size_t c = 0; c < 3; ++c)
        all[corners[n]][c] -= p * l * l / 4 * sign(n, d) * faces[d][c];
}

/// Sums the forces cell by cell. Each cell has the springs of its own material, computed from
/// positions.
template <class MaterialOf>
std::vector<Force> forces_by_cells(const CellShape& shape, const Model& model,
                                   const std::vector<double>& u, const std::vector<double>& heights,
                                   const MaterialOf& material_of) {
  const auto particles = particles_by_corner(model);
  const double delta = model.body.grid.membrane_distance;
  const bool has_heights = !heights.empty();
  std::vector<Force> all(model.body.particles, Force{});
  const auto place = [&](Particle p) {
    const CellIndex x = corner_of(model, p);
    std::array<double, 4> at{};
    for (std::size_t c = 0; c < 3; ++c) at[c] = x[c] * l + u[3 * p + c];
    at[3] = delta / 2 + (has_heights ? heights[p] : 0);
    return at;
  };
  for (const CellIndex& cell : shape.cells()) {
    const std::uint8_t material = material_of(cell);
    add_volumetric(cell, model.materials[material].constants.volumetric, particles, place, all);
    for (int m = 0; m < 8; ++m) {
      const auto corner = [&](int n) {
        return particles.at({cell[0] + (n & 1), cell[1] + (n >> 1 & 1), cell[2] + (n >> 2 & 1)});
      };
      const Particle a = corner(m);
      const MaterialConstants& own = model.materials[material].constants;
      if (has_heights)
        all[a][3] -= own.alpha_ratio * own.base_stiffness / 8 * (2 * place(a)[3] - delta);
      for (int n = 0; n < 8; ++n) {
        const int differing = (m ^ n) == 0 ? 0 : __builtin_popcount(static_cast<unsigned>(m ^ n));
        if (differing != 1 && differing != 2) continue;
        const Particle b = corner(n);
        const double share = differing == 1 ? 0.25 : 0.5, rest = std::sqrt(differing) * l;
        const SpringConstants& spring =
            model.springs.spring(material, material, differing == 1 ? 0 : 1);
        const auto from = place(a), to = place(b);
        const auto pull = [&](double k, double unstretched, double across, double lever) {
          double square = across * across;
          for (std::size_t c = 0; c < 3; ++c) square += (to[c] - from[c]) * (to[c] - from[c]);
          const double tension = share * k * (std::sqrt(square) - unstretched) / std::sqrt(square);
          for (std::size_t c = 0; c < 3; ++c) all[a][c] += tension * (to[c] - from[c]);
          if (has_heights) all[a][3] += tension * lever;
        };
        pull(spring.stiffness, rest, to[3] - from[3], to[3] - from[3]);
        if (model.springs.choice.membrane != KernelChoice::Membrane::none)
          pull(spring.cross_stiffness, std::sqrt(rest * rest + delta * delta), to[3] + from[3],
               -(to[3] + from[3]));
      }
    }
  }
  return all;
}

TEST_P(CellsOfMembrane, LargeMotionsHaveTheForcesOfTheCellsTheirOwnSprings) {
  for (const bool two_materials : {false, true})
    for (const CellShape& shape : cell_shapes()) {
      const Json part = {{"half_space", {{"point", {2e-3, 0, 0}}, {"normal", {-1, 0.2, 0}}}}};
      const Stages other =
          stage("materials.elastic",
                Keys{{"young", 3e10}, {"density", 7000}, {"region", part}} + GetParam().material);
      if (two_materials && shape.cells().size() < 30) continue;
      const auto plan = plan_of(
          scene_of_cells(shape.shape, GetParam().material, two_materials ? other : Stages{}));
      const Model& model = *plan->model;
      const auto u = noise(3 * model.body.particles, 0.1 * l, 5);
      const auto heights = model.degrees_of_freedom == 4 ? noise(model.body.particles, 0.1 * l, 6)
                                                         : std::vector<double>{};
      const auto found = forces(model, u, heights),
                 expected = forces_by_cells(shape, model, u, heights, [&](const CellIndex&cell) {
                   return static_cast<std::uint8_t>(
                       two_materials && -(cell[0] + 0.5 - 2) + 0.2 * (cell[1] + 0.5) <= 0 ? 1 : 0);
                 });
      double worst = 0, largest_force = 0;
      for (Particle p = 0; p < model.body.particles; ++p)
        for (std::size_t c = 0; c < 4; ++c) {
          worst = std::max(worst, std::abs(found[p][c] - expected[p][c]));
          largest_force = std::max(largest_force, std::abs(expected[p][c]));
        }
      EXPECT_LT(worst, 1e-12 * largest_force)
          << shape.name << (two_materials ? ", two materials" : "");
    }
}

/// Poisson ratio and E l / k of a cube at rest between frictionless platens.
struct Uniaxial {
  double poisson, modulus;

  Uniaxial(int n, const std::string& boundary, const char* membrane) {
    constexpr double strain = 1e-12;
    const double size = n;
    const auto plan = plan_of(
        SceneBuilder{}
            .lattice("lattices.cubic", 1, box({}, {size, size, size}), {{"boundary", boundary}})
            .material("materials.elastic", Keys{{"young", 1}, {"density", 1}} + membrane)
            .load("loads.fixed", {{"on", "z_min"}, {"axes", "z"}})
            .load("loads.displacement",
                  {{"on", "z_max"}, {"axes", "z"}, {"value", {0, 0, strain}}, {"rise", 1e-9}})
            .solver("solvers.static", {{"tolerance", 1e-9}})
            .text());
    const Model& model = *plan->model;
    Simulation simulation(model, 1);
    std::vector<double> u(3 * model.body.particles);
    for (Particle p = 0; p < model.body.particles; ++p)
      u[3 * p + 2] = strain * model.body.site(p).k / model.body.high.k;
    simulation.set_displacements(u, {});
    bring_to_rest(*plan, simulation);
    u = displacements(simulation);
    double spread = 0;  // mean inward displacement of the lateral faces
    std::size_t faces = 0;
    for (Particle p = 0; p < model.body.particles; ++p) {
      const Site at = model.body.site(p);
      const int sides[2] = {(at.i == model.body.high.i) - (at.i == model.body.low.i),
                            (at.j == model.body.high.j) - (at.j == model.body.low.j)};
      for (std::size_t c = 0; c < 2; ++c)
        if (sides[c] != 0) {
          spread -= sides[c] * u[3 * p + c];
          ++faces;
        }
    }
    poisson = 2 * spread / static_cast<double>(faces) / strain;
    // This is the distance between the outermost particles.
    const double span = boundary == "cells" ? n : n - 1;
    const double force = -simulation.force_on_load().at(1).z;
    modulus = force / (n * n) / (strain / span) / model.materials[0].constants.base_stiffness;
  }
};

struct UniaxialCase {
  const char* name;
  const char* membrane;
  double poisson, modulus;                              ///< the infinite lattice
  double poisson_4, modulus_4, poisson_10, modulus_10;  ///< boundary particles, 4^3 and 10^3
};
const UniaxialCase uniaxial_cases[] = {
    {"L_0", R"("membrane": "none")", .25, 2.5, .230965, 2.127954, .243257, 2.352596},
    {"L_1", R"("membrane": "I-m", "lambda": 1)", 2. / 11, 39. / 11, .168642, 3.005948, .177543,
     3.325861},
    {"L_2_8", R"("membrane": "I-m", "lambda": 2.8)", .1, 5.28, .097305, 4.478673, .099889,
     4.947698},
};
class UniaxialTest : public testing::TestWithParam<UniaxialCase> {};
INSTANTIATE_TEST_SUITE_P(Ratios, UniaxialTest, testing::ValuesIn(uniaxial_cases),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_P(UniaxialTest, CellsGiveTheEndlessLatticeAtAnySize) {
  for (const int n : {4, 6, 10}) {
    const Uniaxial found(n, "cells", GetParam().membrane);
    std::printf("cells %d: %.6f %.6f\n", n, found.poisson, found.modulus);
    EXPECT_NEAR(found.poisson, GetParam().poisson, 1e-9) << n;
    EXPECT_NEAR(found.modulus, GetParam().modulus, 1e-9) << n;
  }
}

TEST_P(UniaxialTest, WholeParticlesAreSofter) {
  const UniaxialCase& c = GetParam();
  for (const auto& [n, poisson, modulus] :
       {std::tuple{4, c.poisson_4, c.modulus_4}, {10, c.poisson_10, c.modulus_10}}) {
    const Uniaxial found(n, "particles", c.membrane);
    std::printf("particles %d: %.6f %.6f\n", n, found.poisson, found.modulus);
    EXPECT_NEAR(found.poisson, poisson, 1e-6) << n;
    EXPECT_NEAR(found.modulus, modulus, 1e-6) << n;
  }
}

TEST(Cells, EquationFifteenIsTheBulkStiffness) {
  const auto stiffness = [](const char* kind) {
    return plan_of(scene_of_cells(cell_shapes()[5].shape,
                                  {{"membrane", "I-m"}, {"poisson", 0.1}, {"stiffness", kind}}))
        ->model->materials[0]
        .constants.base_stiffness;
  };
  EXPECT_NEAR(stiffness("eq15") / stiffness("bulk"), 1, 1e-14);
}

TEST(Cells, MassIsThatOfTheVolume) {
  for (const CellShape& shape : cell_shapes()) {
    const auto plan = plan_of(scene_of_cells(shape.shape, R"("poisson": 0.25)"));
    double mass = 0;
    for (Particle p = 0; p < plan->model->body.particles; ++p) mass += plan->model->mass(p);
    const double volume = static_cast<double>(shape.cells().size()) * l * l * l;
    EXPECT_NEAR(mass, 2500 * volume, 1e-12 * mass) << shape.name;
  }
}

}  // namespace cells_test
