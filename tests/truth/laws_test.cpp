// Laws with constants and memory: bodies against closed forms, and the energy balance of bodies in
// motion. contract/contract_test.cpp tests what every law must do along the path of one spring.
#include <support/laws.hpp>
#include <support/lists.hpp>

#include <gtest/gtest.h>

namespace laws_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

const LawCase laws[] = {
    {"viscous", R"("type": "materials.viscous", "time": 2e-7, "membrane": "I-m", "poisson": 0.1)"},
    {"relaxing",
     R"("type": "materials.relaxing", "time": 1e-6, "share": 0.6, "membrane": "I-m", "poisson": 0.1)"},
    {"plastic",
     R"("type": "materials.plastic", "yield": 2e6, "hardening": 0.1, "membrane": "none", "poisson": 0.25)"},
    {"softening",
     R"("type": "materials.softening", "strength": 3e6, "fracture_energy": 5, "membrane": "I-m", "poisson": 0.1)"},
};

std::string scene_of(const Json& shape, const Keys& material, const Stages& stages = {},
                     const std::string& boundary = "particles") {
  return law_scene(
      stage("lattices.cubic", {{"spacing", 1e-3}, {"boundary", boundary}, {"shape", shape}}),
      material, stages);
}
const Json block_of_particles = box_mm(5, 4, 6), pair_of_particles = box_mm(1, 1, 2);

/// Holds the lower end and moves the upper end along z.
Stages drawn(double displacement, double rise) {
  return stage("loads.fixed", {{"on", "z_min"}}) +
         stage("loads.displacement",
               {{"on", "z_max"}, {"value", Vec3{0, 0, displacement}}, {"rise", rise}});
}

/// k of the base springs in a lattice without a membrane, E = 10 GPa, spacing 1 mm.
constexpr double stiffness = 0.4 * 1e10 * 1e-3;

// Two particles and one spring.

TEST(Laws, ViscousPairOscillatesAsTheDampedOscillator) {
  const auto plan = plan_of(scene_of(
      pair_of_particles, {{"type", "materials.viscous"}, {"time", 1e-8}, {"membrane", "none"}}));
  Simulation simulation(*plan->model, 1);
  simulation.set_velocities({0, 0, -1, 0, 0, 1}, {});
  const double mass = 2500e-9, omega = std::sqrt(2 * stiffness / mass), ratio = omega * 1e-8 / 2,
               damped = omega * std::sqrt(1 - ratio * ratio);
  const double step = 0.01 / omega;
  double worst = 0;
  for (int n = 1; n <= 3000; ++n) {
    simulation.step(step);
    std::vector<double> xyz;
    simulation.displacements(xyz);
    const double t = (n - 0.0) * step,
                 expected = 2 / damped * std::exp(-ratio * omega * t) * std::sin(damped * t);
    worst = std::max(worst, std::abs(xyz[5] - xyz[2] - expected));
  }
  EXPECT_LT(worst, 0.012 * 2 / omega);
  const EnergyBalance balance = simulation.balance();
  EXPECT_LT(std::abs(balance.relative_error()), 1e-4);
  // The energy at the start is 2 * 1/2 m v^2.
  const double lost = mass * (1 - std::exp(-2 * ratio * 3000 * 0.01));
  EXPECT_NEAR(balance.dissipated(), lost, 0.02 * lost);
}

TEST(Laws, RelaxingPairLosesItsForce) {
  const auto plan = plan_of(scene_of(
      pair_of_particles,
      {{"type", "materials.relaxing"}, {"time", 1e-6}, {"share", 0.6}, {"membrane", "none"}},
      drawn(1e-7, 1e-8)));
  Simulation simulation(*plan->model, 1);
  const double step = 1e-8;
  for (int n = 1; n <= 300; ++n) {
    simulation.step(step);
    if (n % 50 != 0) continue;
    const double held = (n - 0.5) * step,
                 // The first step has moved the particles.
        expected = stiffness * 1e-7 * (0.4 + 0.6 * std::exp(-held / 1e-6));
    EXPECT_NEAR(std::abs(simulation.force_on_load()[1].z), expected, 2e-3 * expected) << n;
  }
}

TEST(Laws, SofteningLayersTakeTheFractureEnergyApart) {
  const auto plan = plan_of(scene_of(box_mm(10, 10, 2),
                                     {{"type", "materials.softening"},
                                      {"strength", 3e6},
                                      {"fracture_energy", 2},
                                      {"membrane", "none"}},
                                     drawn(1e-5, 1e-4)));
  Simulation simulation(*plan->model, 1);
  for (int n = 0; n < 2000; ++n) simulation.step(5e-8);
  const EnergyBalance balance = simulation.balance();
  // In a large body, k l^2 of all springs through one site's part of the plane has the sum 9 k l^2.
  const double expected = 2 * 1e-6 * (100 + 2 * 360) / 9;
  EXPECT_NEAR(balance.dissipated(), expected, 1e-3 * expected);
  EXPECT_LT(std::abs(balance.stored), 1e-6 * expected);
  EXPECT_LT(std::abs(balance.relative_error()), 1e-3);
}

// A bar.

// The bar is elastic up to the stated stress, and the stress stays there. Heights are at rest, or
// the membrane has none.
TEST(Laws, PlasticBarYieldsAtTheStatedStress) {
  for (const char* membrane :
       {R"("membrane": "none")", R"("membrane": "I-m", "poisson": 0.1)",
        R"("membrane": "II", "poisson": 0.1)", R"("membrane": "IV", "poisson": 0.1)"}) {
    const auto moved = [](const char* on, double by, double rise) {
      return stage("loads.displacement",
                   {{"on", on}, {"value", Vec3{by, 0, 0}}, {"axes", "x"}, {"rise", rise}});
    };
    const auto plan = plan_of(
        scene_of(box_mm(6, 3, 3), Keys{{"type", "materials.plastic"}, {"yield", 2e6}} + membrane,
                 moved("x_min", 0, 1e-4) + moved("x_max", 3.6e-6, 4e-4), "cells"));
    Simulation simulation(*plan->model, 1);
    simulation.set_damping(0.8);
    const double area = 9e-6, step = 0.5 * plan->model->step_limit.time_step,
                 end = 4e-4;  // strain 6e-4 at the end, 2e-4 at yield
    double last = 0, worst = 0;
    while (simulation.time() < end) {
      simulation.step(step);
      const double strain = 6e-4 * simulation.time() / end;
      if (strain - last < 5e-5) continue;
      last = strain;
      const double stress = std::abs(simulation.force_on_load()[1].x) / area,
                   expected = std::min(1e10 * strain, 2e6);
      EXPECT_NEAR(stress, expected, 0.02 * 2e6) << membrane << ", strain " << strain;
      worst = std::max(worst, std::abs(stress - expected) / 2e6);
    }
    std::printf("%s: within %.2f %% of the yield stress\n", membrane, 100 * worst);
  }
}

// Bodies in motion.

class MovingLaw : public testing::TestWithParam<LawCase> {};
INSTANTIATE_TEST_SUITE_P(All, MovingLaw, testing::ValuesIn(laws),
                         [](const auto& info) { return info.param.name; });

TEST_P(MovingLaw, KeepsTheBooks) {
  const auto plan = plan_of(scene_of(block_of_particles, GetParam().material));
  const Ended coarse = shaken(*plan, 0.4, 200, 1), fine = shaken(*plan, 0.1, 800, 1);
  EXPECT_GT(fine.balance.dissipated(), 0.02 * fine.balance.scale);
  EXPECT_LT(std::abs(fine.balance.relative_error()), 1e-4);
  EXPECT_LT(std::abs(coarse.balance.relative_error()), 2e-3);
}

TEST_P(MovingLaw, GivesTheSameBitsForAnyNumberOfThreads) {
  for (const bool breaks : {false, true}) {
    const std::string scene =
        scene_of(block_of_particles, GetParam().material + (breaks ? law_failure : Keys{}));
    for (const auto& plan : {plan_of(scene), plan_of(in_floats(scene))}) {
      const Ended one = shaken(*plan, 0.4, 100, 1);
      EXPECT_EQ(breaks, one.broken > 0);
      for (const int threads : {2, 3, 6})
        EXPECT_EQ(shaken(*plan, 0.4, 100, threads).hash, one.hash) << threads;
    }
  }
}

TEST_P(MovingLaw, KeepsTheBooksWhileSpringsBreak) {
  const std::string scene = scene_of(block_of_particles, GetParam().material + law_failure);
  for (const auto& plan : {plan_of(scene), plan_of(in_floats(scene))}) {
    const Ended ended = shaken(*plan, 0.1, 400, 2);
    EXPECT_GT(ended.broken, 10u);
    EXPECT_LT(std::abs(ended.balance.relative_error()), 2e-3);
  }
}

// Laws compute in doubles at either precision of the state. The same displacements give the same
// forces, up to the rounding of the velocities.
TEST_P(MovingLaw, GivesInFloatsTheForcesOfDoubles) {
  for (const char* boundary : {"particles", "cells"}) {
    const std::string scene = scene_of(block_of_particles, GetParam().material, {}, boundary);
    const auto doubles = plan_of(scene), floats = plan_of(in_floats(scene));
    LedBody exact(*doubles->model), rounded(*floats->model, 2);
    std::vector<double> u(3 * doubles->model->body.particles, 0.0);
    for (unsigned step = 0; step < 60; ++step) {
      const std::vector<double> move = noise(u.size(), 3e-7, step);
      for (std::size_t n = 0; n < u.size(); ++n) u[n] = double{static_cast<float>(u[n] + move[n])};
      const std::vector<double> expected = exact.forces(u);
      EXPECT_LT(distance(rounded.forces(u), expected), 1e-7 * largest(expected));
    }
  }
}

TEST_P(MovingLaw, KeepsTheBooksInFloats) {
  const auto plan = plan_of(in_floats(scene_of(block_of_particles, GetParam().material)));
  const Ended fine = shaken(*plan, 0.1, 800, 1);
  EXPECT_GT(fine.balance.dissipated(), 0.02 * fine.balance.scale);
  EXPECT_LT(std::abs(fine.balance.relative_error()), 1e-4);
}

Fault refused(const std::string& scene) {
  try {
    plan_of(scene);
  } catch (const InputError& error) {
    return error.faults().front();
  }
  return Fault{};
}

TEST(Laws, RefuseWhatTheyCannotDo) {
  const auto expected = [](const char* material) {
    return refused(scene_of(block_of_particles, material)).expected;
  };
  EXPECT_NE(
      expected(
          R"("type": "materials.softening", "strength": 3e6, "fracture_energy": 1e-3, "membrane": "none")")
          .find("a spacing below"),
      std::string::npos);
  EXPECT_NE(
      expected(R"("type": "materials.plastic", "yield": 3e6, "membrane": "I", "poisson": 0.2)")
          .find("springs across a bar would yield"),
      std::string::npos);
  EXPECT_NE(
      expected(R"("type": "materials.plastic", "yield": 3e6, "membrane": "IV", "poisson": 0.3)")
          .find("negative stiffness"),
      std::string::npos);
  const char* none =
      R"("type": "materials.plastic", "yield": 3e6, "membrane": "none", "poisson": )";
  EXPECT_EQ(expected((none + std::string("0.33")).c_str()), "");
  // A diagonal along the bar grows by (1 - nu) / 2, one across it shrinks by nu.
  EXPECT_NE(expected((none + std::string("0.4")).c_str())
                .find("poisson at most 1/3: springs across a bar would yield at 0.75"),
            std::string::npos);
}

}  // namespace laws_test
