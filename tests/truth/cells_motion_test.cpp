// Bodies of cells in motion keep momentum and energy, also while springs break, and their bits do
// not depend on the number of threads.
#include <support/cells.hpp>
#include <support/energy_balance.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace cells_motion_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

const CellShape& shape(const std::string& name) {
  return *std::find_if(cell_shapes().begin(), cell_shapes().end(),
                       [&](const CellShape& s) { return s.name == name; });
}

void shake(Simulation& simulation, const Model& model, double amplitude) {
  const std::size_t particles = model.body.particles;
  const bool heights = model.degrees_of_freedom == 4;
  simulation.set_displacements(noise(3 * particles, amplitude, 1),
                               heights ? noise(particles, amplitude, 2) : std::vector<double>{});
  simulation.set_velocities(noise(3 * particles, amplitude / model.step_limit.time_step, 3), {});
}

class MovingCells : public testing::TestWithParam<MembraneCase> {};
INSTANTIATE_TEST_SUITE_P(Membranes, MovingCells, testing::ValuesIn(membrane_cases),
                         [](const auto& info) { return std::string(info.param.name); });
INSTANTIATE_TEST_SUITE_P(Volumetric, MovingCells, testing::ValuesIn(volumetric),
                         [](const auto& info) { return std::string(info.param.name); });
INSTANTIATE_TEST_SUITE_P(VolumetricBelow, MovingCells, testing::ValuesIn(volumetric_below),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_P(MovingCells, KeepTheirMomentumAndEnergy) {
  for (const char* name : {"L", "touching_in_an_edge"}) {
    const auto plan = plan_of(scene_of_cells(shape(name).shape, GetParam().material));
    const Model& model = *plan->model;
    Simulation simulation(model, 2);
    shake(simulation, model, 1e-11);
    simulation.step(0.5 * model.step_limit.time_step);
    const EnergyBalance start = simulation.balance();
    double mass = 0, worst = 0;
    for (Particle p = 0; p < model.body.particles; ++p) mass += model.mass(p);
    for (int n = 0; n < 500; ++n) {
      simulation.step(0.5 * model.step_limit.time_step);
      if (n % 50 == 49) worst = std::max(worst, std::abs(simulation.balance().relative_error()));
    }
    EXPECT_LT(norm(simulation.balance().momentum - start.momentum),
              1e-13 * std::sqrt(2 * start.kinetic_mean * mass))
        << name;
    EXPECT_LT(worst, 1e-6) << name;  // strains near 1e-8
  }
}

TEST(Cells, BalanceTheirEnergy) {
  const Stages held = stage("loads.fixed", {{"on", "z_min"}}),
               force = stage("loads.force", {{"on", "z_max"}, {"total", {5, 0, 20}}});
  const std::tuple<const char*, Stages, double, double> flows[] = {
      {"hanging", held + stage("loads.gravity", {{"acceleration", {1, 2, -9.81}}}), 0, 1e-10},
      {"pulled", held + force, 0, 2e-4},
      {"damped", held + force, 0.5, 1e-6},
      {"driven",
       held + stage("loads.velocity", {{"on", "z_max"}, {"axes", "z"}, {"value", {0, 0, 1}}}), 0,
       2e-4},
  };
  for (const char* membrane : {R"("poisson": 0.25)", R"("membrane": "I-m", "poisson": 0.1)"})
    for (const auto& [name, loads, damping, tolerance] : flows) {
      const auto plan = plan_of(scene_of_cells(box_mm(5, 4, 7), membrane, loads));
      const double coarse = worst_balance(*plan->model, 0.4, damping).largest_error,
                   fine = worst_balance(*plan->model, 0.1, damping).largest_error;
      EXPECT_LT(coarse, tolerance) << name << membrane;
      EXPECT_LT(fine, std::max(1e-13, coarse / 10))
          << name << membrane << ": a quarter of the step, a sixteenth of the error";
    }
}

/// The membranes of two materials with breakable springs, pulled apart.
struct Breaking {
  const char *name, *first, *second;
};
const Breaking breakings[] = {
    {"I_m", R"("membrane": "I-m", "poisson": 0.2)", R"("membrane": "I-m", "poisson": 0.1)"},
    {"volumetric", R"("poisson": 0.45)", R"("poisson": 0.3)"},
    {"volumetric_beside_a_membrane", R"("poisson": 0.4)", R"("membrane": "I-m", "poisson": 0.1)"},
};
std::unique_ptr<Plan> breaking(const Breaking& of, int threads = 1) {
  const Keys failure = {{"failure", {{"type", "failures.elongation"}, {"limit", 1e-6}}}};
  const Json part = {{"half_space", {{"point", {0, 2.1e-3, 0}}, {"normal", {0, 1, 0.3}}}}};
  const Keys second = {{"young", 3e10}, {"density", 7000}, {"region", part}};
  return plan_of(scene_of_cells(box_mm(5, 6, 11), Keys(of.first) + failure,
                                stage("materials.elastic", second + Keys(of.second) + failure) +
                                    stage("loads.velocity",
                                          {{"on", "z_max"}, {"axes", "z"}, {"value", {0, 0, 4}}}) +
                                    stage("loads.fixed", {{"on", "z_min"}})),
                 threads);
}
class BreakingCells : public testing::TestWithParam<Breaking> {};
INSTANTIATE_TEST_SUITE_P(Materials, BreakingCells, testing::ValuesIn(breakings),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_P(BreakingCells, TakeTheEnergyOfWhatIsGone) {
  const auto plan = breaking(GetParam());
  const auto run = [&](double fraction) {
    Simulation simulation(*plan->model, 2);
    const int steps =
        static_cast<int>(std::ceil(8e-6 / (fraction * plan->model->step_limit.time_step)));
    double worst = 0, lost = 0;
    for (int n = 0; n < steps; ++n) {
      simulation.step(8e-6 / steps);
      const EnergyBalance balance = simulation.balance();
      worst = std::max(worst, std::abs(balance.relative_error()));
      EXPECT_GE(balance.dissipated_failure, lost);  // no failure gives energy
      lost = balance.dissipated_failure;
    }
    EXPECT_GT(simulation.breakages().size(), 30u);
    EXPECT_GT(simulation.balance().dissipated_failure, 0.1 * simulation.balance().injected);
    return worst;
  };
  const double coarse = run(0.5), fine = run(0.05);
  std::printf(
      "breaking cells: largest relative error %.1e at 0.5 of the critical step, %.1e at 0.05\n",
      coarse, fine);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_LT(fine, coarse / 30);
}

TEST_P(BreakingCells, HaveTheSameBitsForAnyNumberOfThreads) {
  const auto result = [](int threads) {
    const auto plan = breaking(GetParam(), threads);
    Simulation simulation(*plan->model, threads);
    simulation.set_damping(0.1);
    shake(simulation, *plan->model, 1e-7);
    for (int n = 0; n < 100; ++n) simulation.step(0.8 * plan->model->step_limit.time_step);
    const EnergyBalance balance = simulation.balance();
    return std::tuple{simulation.hash(), simulation.breakages().size(), balance.stored,
                      balance.kinetic, balance.dissipated_failure};
  };
  const auto one = result(1);
  EXPECT_GT(std::get<1>(one), 30u);
  EXPECT_EQ(result(2), one);
  EXPECT_EQ(result(3), one);
}

}  // namespace cells_motion_test
