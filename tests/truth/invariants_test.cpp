// A free undamped lattice keeps momentum and energy with any springs, behaves the same after a
// rotation, and gives bits that do not depend on the number of threads.
#include <support/scenes.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace invariants_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

class EveryMembrane : public testing::TestWithParam<MembraneCase> {};
const auto name_of = [](const testing::TestParamInfo<MembraneCase>& info) {
  return std::string(info.param.name);
};
INSTANTIATE_TEST_SUITE_P(Membranes, EveryMembrane, testing::ValuesIn(membrane_cases), name_of);
INSTANTIATE_TEST_SUITE_P(Volumetric, EveryMembrane, testing::ValuesIn(volumetric), name_of);
INSTANTIATE_TEST_SUITE_P(CentredLattices, EveryMembrane, testing::ValuesIn(centred_lattices),
                         name_of);

/// Sets random displacements and heights of the given amplitude, and random velocities that fit
/// them.
void shake(Simulation& simulation, const Model& model, double amplitude) {
  const std::size_t particles = model.body.particles;
  const bool heights = model.degrees_of_freedom == 4;
  simulation.set_displacements(noise(3 * particles, amplitude, 1),
                               heights ? noise(particles, amplitude, 2) : std::vector<double>{});
  simulation.set_velocities(noise(3 * particles, amplitude / model.step_limit.time_step, 3), {});
}

TEST_P(EveryMembrane, MomentumOfAFreeBodyIsKept) {
  const auto plan = plan_of(block(7, 6, 5, GetParam()));
  const Model& model = *plan->model;
  Simulation simulation(model, 1);
  shake(simulation, model, 1e-5);
  const EnergyBalance start = simulation.balance();
  const double scale = std::sqrt(2 * start.kinetic_mean * model.materials[0].mass *
                                 static_cast<double>(model.body.particles));
  for (int n = 0; n < 500; ++n) simulation.step(0.5 * model.step_limit.time_step);
  EXPECT_LT(norm(simulation.balance().momentum - start.momentum), 1e-13 * scale);
}

TEST_P(EveryMembrane, ADragInProportionToMassTakesMomentumAtItsRate) {
  const auto plan = plan_of(block(7, 6, 5, GetParam()));
  const Model& model = *plan->model;
  Simulation simulation(model, 1);
  shake(simulation, model, 1e-11);  // strains near 1e-8
  constexpr double x = 0.05;        // half of the share that the drag takes in one step
  const double step = 0.5 * model.step_limit.time_step;
  simulation.set_damping(0, 2 * x / step);
  simulation.step(step);
  const EnergyBalance start = simulation.balance();
  constexpr int steps = 20;
  for (int n = 0; n < steps; ++n) simulation.step(step);
  const EnergyBalance end = simulation.balance();
  const double left = std::pow((1 - x) / (1 + x), steps);
  EXPECT_LT(norm(end.momentum - left * start.momentum), 1e-10 * norm(start.momentum));
  EXPECT_GT(end.dissipated(), 0.5 * start.kinetic);
  EXPECT_LT(std::abs(end.error - start.error),
            1e-6 * start.kinetic);  // the first half step is of first order
}

TEST_P(EveryMembrane, TheSchemesEnergyIsConstantForSmallStrains) {
  const auto plan = plan_of(block(5, 5, 5, GetParam()));
  Simulation simulation(*plan->model, 1);
  shake(simulation, *plan->model, 1e-11);  // strains near 1e-8
  const double step = 0.5 * plan->model->step_limit.time_step;
  simulation.step(step);
  const EnergyBalance start = simulation.balance();
  double worst = 0;
  for (int n = 0; n < 10000; ++n) {
    simulation.step(step);
    if (n % 100 != 99) continue;
    const EnergyBalance now = simulation.balance();
    worst =
        std::max(worst, std::abs((now.kinetic + now.stored) / (start.kinetic + start.stored) - 1));
  }
  EXPECT_LT(worst, 1e-6);
}

/// Largest relative change of the energy with the mean kinetic energy, at strains near 1e-3.
double plain_energy_departure(const Model& model, double fraction, int steps) {
  Simulation simulation(model, 1);
  shake(simulation, model, 1e-6);
  const double start = simulation.balance().kinetic_mean + simulation.balance().stored;
  double worst = 0;
  for (int n = 0; n < steps; ++n) {
    simulation.step(fraction * model.step_limit.time_step);
    const EnergyBalance now = simulation.balance();
    worst = std::max(worst, std::abs((now.kinetic_mean + now.stored) / start - 1));
  }
  return worst;
}

TEST_P(EveryMembrane, ThePlainEnergyOscillatesWithTheSquareOfTheStep) {
  const auto plan = plan_of(block(5, 5, 5, GetParam()));
  const double coarse = plain_energy_departure(*plan->model, 0.4, 400),
               fine = plain_energy_departure(*plan->model, 0.2, 800);
  EXPECT_GT(coarse, 1e-4);  // the oscillation is not round-off
  EXPECT_GT(coarse / fine, 3.2);
  EXPECT_LT(coarse / fine, 5.0);
}

TEST_P(EveryMembrane, ThePlainEnergyDoesNotDrift) {
  const auto plan = plan_of(block(5, 5, 5, GetParam()));
  const double step = 0.4 * plan->model->step_limit.time_step;
  Simulation simulation(*plan->model, 1);
  shake(simulation, *plan->model, 1e-6);
  const auto mean_of_steps = [&](int steps) {
    double sum = 0;
    for (int n = 0; n < steps; ++n) {
      simulation.step(step);
      const EnergyBalance now = simulation.balance();
      sum += now.kinetic_mean + now.stored;
    }
    return sum / steps;
  };
  const double early = mean_of_steps(1000);
  for (int n = 0; n < 8000; ++n) simulation.step(step);
  EXPECT_NEAR(mean_of_steps(1000) / early, 1, 2e-3);
}

/// Rotation by an angle about an axis (Rodrigues).
Vec3 rotated(Vec3 v, Vec3 axis, double angle) {
  const Vec3 n = (1 / norm(axis)) * axis;
  return std::cos(angle) * v + std::sin(angle) * cross(n, v) +
         ((1 - std::cos(angle)) * dot(n, v)) * n;
}

/// Turns a body as a whole: `values` are displacements if `places`, otherwise velocities.
std::vector<double> turned(const Model& model, const std::vector<double>& values, Vec3 axis,
                           double angle, bool places) {
  std::vector<double> result(values.size());
  for (Particle p = 0; p < model.body.particles; ++p) {
    const Vec3 rest = places ? model.body.position(p) : Vec3{};
    const Vec3 now =
        rotated(rest + Vec3{values[3 * p], values[3 * p + 1], values[3 * p + 2]}, axis, angle) -
        rest;
    result[3 * p] = now.x;
    result[3 * p + 1] = now.y;
    result[3 * p + 2] = now.z;
  }
  return result;
}

TEST_P(EveryMembrane, RotatingTheWholeBodyChangesNothing) {
  const auto plan = plan_of(block(6, 5, 4, GetParam()));
  const Model& model = *plan->model;
  const std::size_t particles = model.body.particles;
  const auto start = noise(3 * particles, 1e-6, 5),
             speeds = noise(3 * particles, 1e-6 / model.step_limit.time_step, 6);
  const Vec3 axis{0.3, -0.8, 0.52};
  Simulation straight(model, 1), rotating(model, 1);
  straight.set_displacements(start, {});
  straight.set_velocities(speeds, {});
  rotating.set_displacements(turned(model, start, axis, 2.1, true), {});
  rotating.set_velocities(turned(model, speeds, axis, 2.1, false), {});
  for (int n = 0; n < 300; ++n) {
    straight.step(0.5 * model.step_limit.time_step);
    rotating.step(0.5 * model.step_limit.time_step);
  }
  const auto expected = turned(model, displacements(straight), axis, 2.1, true);
  EXPECT_LT(distance(expected, displacements(rotating)),
            1e-13);  // m: the body is 6 mm long and deforms by 1e-6 m
  EXPECT_NEAR(straight.balance().stored, rotating.balance().stored,
              1e-8 * straight.balance().stored);
}

TEST_P(EveryMembrane, ABodyThatOnlyTurnedStoresNothing) {
  const auto plan = plan_of(block(6, 5, 4, GetParam()));
  const Model& model = *plan->model;
  Simulation simulation(model, 1);
  simulation.set_displacements(
      turned(model, std::vector<double>(3 * model.body.particles, 0), {1, 2, 3}, 1.0, true), {});
  const double volume = static_cast<double>(model.body.particles) * 1e-9;
  EXPECT_LT(std::abs(simulation.balance().stored), 1e-20 * 1e10 * volume);
}

TEST_P(EveryMembrane, TheSameBitsForAnyNumberOfThreads) {
  const char* failure = R"(, "failure": { "type": "failures.elongation", "limit": 1.5e-6 })";
  const auto plan = plan_of(block(9, 8, 11, GetParam(), failure,
                                  R"({ "type": "loads.gravity", "acceleration": [0, 0, -9.81] },
    { "type": "loads.fixed", "on": "z_min", "axes": "xyz" }, { "type": "loads.force", "on": "z_max", "total": [10, 0, 20] })"));
  std::vector<std::uint64_t> hashes;
  std::vector<double> energies;
  std::vector<std::size_t> broken;
  // Lattices with two planes in each cell have 22 planes here.
  for (const int threads : {1, 2, 3, 11, 22}) {
    Simulation simulation(*plan->model, threads);
    simulation.set_damping(0.1, 1e4);
    shake(simulation, *plan->model, 1e-6);
    for (int n = 0; n < 200; ++n) simulation.step(0.5 * plan->model->step_limit.time_step);
    hashes.push_back(simulation.hash());
    const EnergyBalance balance = simulation.balance();
    energies.push_back(balance.kinetic + balance.stored + balance.dissipated() + balance.injected);
    broken.push_back(simulation.breakages().size());
  }
  EXPECT_GT(broken[0], 20u);
  for (std::size_t n = 1; n < hashes.size(); ++n) {
    EXPECT_EQ(hashes[n], hashes[0]);
    EXPECT_EQ(energies[n], energies[0]);  // to the last bit
    EXPECT_EQ(broken[n], broken[0]);
  }
}

}  // namespace invariants_test
