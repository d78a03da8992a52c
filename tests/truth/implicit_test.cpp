// Implicit steps in time against closed forms, explicit steps and conservation: momentum, angular
// momentum and energy at large rotations, the order of the method, its damping, and steps that are
// much longer than the critical one.
#include <base/errors.hpp>
#include <support/motion.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace implicit_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

Stages implicit_to(double end, double step, const Keys& more = {}) {
  return stage("solvers.implicit", Keys{{"end_time", end}, {"time_step", step}} + more);
}

/// A bar along x of n cells of 1 mm, wave speed about 1000 m/s; held at x = 0.
std::string bar(int n, const Stages& loads, const Stages& solvers, const Keys& material = {},
                const std::string& law = "materials.elastic") {
  return SceneBuilder{}
      .lattice("lattices.cubic", 1e-3, box_mm(n, 2, 2), {{"boundary", "cells"}})
      .material(law, Keys{{"young", 1e9}, {"poisson", 0.25}, {"density", 1000}} + material)
      .stage("loads.fixed", {{"on", "x_min"}})
      .stages(loads)
      .stages(solvers)
      .text();
}

class EveryBody : public testing::TestWithParam<MembraneCase> {};
const auto name_of = [](const testing::TestParamInfo<MembraneCase>& info) {
  return std::string(info.param.name);
};
INSTANTIATE_TEST_SUITE_P(Membranes, EveryBody, testing::ValuesIn(membrane_cases), name_of);
INSTANTIATE_TEST_SUITE_P(Volumetric, EveryBody, testing::ValuesIn(volumetric), name_of);
INSTANTIATE_TEST_SUITE_P(VolumetricBelow, EveryBody, testing::ValuesIn(volumetric_below), name_of);
INSTANTIATE_TEST_SUITE_P(CentredLattices, EveryBody, testing::ValuesIn(centred_lattices), name_of);

TEST_P(EveryBody, KeepsMomentaAndEnergyAsItSpins) {
  // Ten steps of 10 critical ones, of a body that is shaken at strains of a percent and that turns
  // by 0.3 in each step.
  const std::string scene = block(5, 4, 3, GetParam());
  const double critical = plan_of(scene)->model->step_limit.time_step, step = 10 * critical;
  SceneBuilder builder(scene);
  builder.stage("loads.start_velocity",
                {{"angular", Vec3{0, 0.2, 0.3} * (1 / step)}, {"linear", {1, 2, 3}}});
  Json json = builder.json();
  for (Json& stage : json["pipeline"])
    if (stage["type"] == "solvers.explicit")
      stage = implicit_to(10 * step, step, {{"residual", 1e-11}}).json()[0];
  Motion run(json.dump());
  const Model& model = run.model();
  const std::size_t particles = model.body.particles;
  const bool heights = model.degrees_of_freedom == 4;
  run.simulation.set_displacements(noise(3 * particles, 1e-5, 1),
                                   heights ? noise(particles, 1e-5, 2) : std::vector<double>{});
  const EnergyBalance start = run.simulation.balance();
  const Vec3 turning = run.angular_momentum();
  double largest = 0;
  run.go([&] { largest = std::max(largest, std::abs(run.simulation.balance().error)); });
  const EnergyBalance end = run.simulation.balance();
  const Vec3 turned = run.angular_momentum() - turning;
  std::printf("momentum %.1e, angular momentum %.1e, energy %.1e of %.3g J stored at the start\n",
              norm(end.momentum - start.momentum) / norm(start.momentum),
              norm(turned) / norm(turning), largest / start.stored, start.stored);
  EXPECT_LT(norm(end.momentum - start.momentum), 1e-10 * norm(start.momentum));
  EXPECT_LT(norm(turned), 1e-10 * norm(turning));
  // Springs keep it to round-off; the volumetric energy is not quadratic.
  const bool cells = !model.volumetric.empty();
  EXPECT_LT(largest, (cells ? 1e-2 : 1e-8) * start.stored);
}

TEST(Implicit, IsOfSecondOrder) {
  const auto end_after = [](const Stages& solver) {
    Motion run(bar(12, stage("loads.gravity", {{"acceleration", {1000, 0, 0}}}), solver));
    run.go();
    return run.end();
  };
  constexpr double end = 40e-6;  // nearly a period of the slowest motion
  const double truth =
      end_after(stage("solvers.explicit", {{"end_time", end}, {"time_step", 2e-8}}));
  double before = 0;
  for (const double step : {4e-6, 2e-6, 1e-6}) {
    const double error = std::abs(end_after(implicit_to(end, step)) - truth);
    std::printf("step %.0e s: error %.2e of %.3e m\n", step, error, truth);
    if (before > 0) {
      EXPECT_NEAR(std::log2(before / error), 2, 0.35);
    }
    before = error;
  }
}

TEST(Implicit, FallsExactlyAndTakesWholeImpulses) {
  // Free fall with a push that is much shorter than a step.
  Motion run(
      SceneBuilder{}
          .lattice("lattices.cubic", 1e-3, box_mm(4, 3, 3))
          .material("materials.elastic", {{"young", 1e9}, {"poisson", 0.25}, {"density", 1000}})
          .stage("loads.gravity", {{"acceleration", {0, 0, -10}}})
          .stage("loads.expression", {{"on", "all"},
                                      {"total", {1, 0, 0}},
                                      {"expression", "t < 3.1e-3 ? 0 : (t < 3.102e-3 ? 1 : 0)"},
                                      {"corners", {3.1e-3, 3.102e-3}}})
          .stages(implicit_to(0.02, 1e-3))
          .text());
  run.go();
  const EnergyBalance end = run.simulation.balance();
  const double mass = run.model().materials[0].mass * double(run.model().body.particles);
  EXPECT_NEAR(end.momentum.z, -mass * 10 * 0.02, 1e-10 * mass);
  EXPECT_NEAR(end.momentum.x, 2e-6, 1e-15);
  EXPECT_NEAR(displacements(run.simulation)[2], -0.5 * 10 * 0.02 * 0.02, 1e-12);
  EXPECT_LT(std::abs(end.relative_error()), 1e-8);
}

TEST(Implicit, FliesAThousandSpacingsInAStep) {
  // Strains have few digits left after 200 m: the solver must see that forces are round-off.
  Motion run(
      SceneBuilder{}
          .lattice("lattices.cubic", 1e-3, box_mm(4, 3, 3))
          .material("materials.elastic", {{"young", 1e9}, {"poisson", 0.25}, {"density", 1000}})
          .stage("loads.start_velocity", {{"linear", {10, 0, 0}}})
          .stages(implicit_to(20, 0.1))
          .text());
  run.go();
  EXPECT_EQ(run.simulation.steps(), 200U);
  EXPECT_NEAR(run.end(), 200, 1e-9);
  EXPECT_NEAR(run.simulation.balance().momentum.x / (36e-6 * 10), 1, 1e-11);
}

TEST(Implicit, ViscousBarCreepsInStepsOfThousandsOfCriticalOnes) {
  // After Kelvin and Voigt: u = F L / (E A) (1 - exp(-t / tau)), with tau = 2 ms, far beyond the
  // waves' 12 us. The explicit limit of this law would be 4e-11 s.
  constexpr double tau = 2e-3;
  const auto bar_of = [&](double step, double residual) {
    return bar(12, stage("loads.force", {{"on", "x_max"}, {"total", {0.04, 0, 0}}}),
               implicit_to(2 * tau, step, {{"residual", residual}}), {{"time", tau}},
               "materials.viscous");
  };
  Motion rest(bar(12, stage("loads.force", {{"on", "x_max"}, {"total", {0.04, 0, 0}}}),
                  stage("solvers.static", {{"end_time", 0}})));
  rest.go();
  double before = 0;
  for (const double parts : {5, 10, 20}) {
    Motion run(bar_of(tau / parts, 1e-9));
    double largest = 0, error = 0;
    run.go([&] {
      const EnergyBalance now = run.simulation.balance();
      largest = std::max(largest, std::abs(now.relative_error()));
      error = std::max(
          error, std::abs(run.end() / rest.end() - (1 - std::exp(-run.simulation.time() / tau))));
    });
    std::printf("tau / %g, %.0f critical steps: creep within %.2e, balance %.1e\n", parts,
                tau / parts / run.critical(), error, largest);
    EXPECT_LT(error, 0.04 / (parts * parts));
    EXPECT_LT(largest, 1e-6);
    if (before > 0) {
      EXPECT_GT(before / error, 2.5);
    }
    before = error;
  }
}

TEST(Implicit, DampingShrinksFastMotionsAndIsBooked) {
  constexpr double damping = 0.2;
  const std::string scene =
      bar(8, {}, implicit_to(5e-3, 1e-3, {{"damping", damping}, {"residual", 1e-11}}));
  Motion run(scene);
  const std::size_t particles = run.model().body.particles;
  run.simulation.set_displacements(noise(3 * particles, 1e-9, 1), {});
  const double start = run.simulation.balance().stored;
  std::vector<double> energy;
  run.go([&] {
    const EnergyBalance now = run.simulation.balance();
    energy.push_back(now.stored + now.kinetic);
    EXPECT_LT(std::abs(now.error), 1e-6 * start);
  });
  const double shrinks = std::pow((1 - damping) / (1 + damping), 2);
  for (std::size_t n = 2; n < energy.size(); ++n)  // the first step moves held particles
    EXPECT_NEAR(energy[n] / energy[n - 1], shrinks, 0.01);
}

TEST(Implicit, GoesBetweenExplicitStages) {
  // A bar under a sudden weight: explicit, implicit with short steps, explicit again.
  Motion run(bar(12, stage("loads.gravity", {{"acceleration", {1000, 0, 0}}}),
                 stage("solvers.explicit", {{"end_time", 12e-6}, {"safety", 0.5}}) +
                     implicit_to(30e-6, 2.5e-7, {{"residual", 1e-9}}) +
                     stage("solvers.explicit", {{"end_time", 45e-6}, {"safety", 0.5}})));
  double largest = 0;
  run.go([&] { largest = std::max(largest, std::abs(run.simulation.balance().relative_error())); });
  Motion whole(bar(12, stage("loads.gravity", {{"acceleration", {1000, 0, 0}}}),
                   stage("solvers.explicit", {{"end_time", 45e-6}, {"safety", 0.5}})));
  whole.go();
  std::printf("end %.6e, explicit %.6e m, balance %.1e\n", run.end(), whole.end(), largest);
  const double deflection = 0.5 * 1000 * 1000 * 0.012 * 0.012 / 1e9;  // rho g L^2 / 2 E
  EXPECT_NEAR(run.end(), whole.end(), 1e-3 * deflection);
  EXPECT_LT(largest, 1e-5);
}

TEST(Implicit, MovesWhatLoadsMoveAndBooksTheWork) {
  // A bar that is pulled at a constant speed from rest, in steps of many critical ones.
  Motion run(bar(12,
                 stage("loads.velocity",
                       {{"on", "x_max"}, {"value", {0.1, 0, 0}}, {"axes", "x"}, {"rise", 1e-3}}),
                 implicit_to(4e-3, 1e-4, {{"residual", 1e-9}})));
  double largest = 0;
  run.go([&] { largest = std::max(largest, std::abs(run.simulation.balance().relative_error())); });
  EXPECT_NEAR(run.end(), 0.1 * 3.5e-3, 1e-9);
  EXPECT_LT(largest, 1e-5);
  const EnergyBalance end = run.simulation.balance();
  EXPECT_GT(end.injected, 0.9 * end.stored);
}

TEST(Implicit, AutomaticStepsKeepTheirTolerance) {
  // One stiff part in a soft bar: steps follow the slow motion.
  const auto bar_with = [](const Stages& solver) {
    return SceneBuilder{}
        .lattice("lattices.cubic", 1e-3, box_mm(12, 2, 2), {{"boundary", "cells"}})
        .region("hard", box({0.004, 0, 0}, {0.006, 0.002, 0.002}))
        .material("materials.elastic", {{"young", 1e7}, {"poisson", 0.25}, {"density", 1000}})
        .material("materials.elastic", {{"name", "hard"},
                                        {"region", "hard"},
                                        {"young", 1e11},
                                        {"poisson", 0.25},
                                        {"density", 1000}})
        .stage("loads.fixed", {{"on", "x_min"}})
        .stage("loads.gravity", {{"acceleration", {10, 0, 0}}})
        .stages(solver)
        .text();
  };
  constexpr double end = 4e-4;
  Motion truth(bar_with(stage("solvers.explicit", {{"end_time", end}})));
  double farthest = 0;
  truth.go([&] { farthest = std::max(farthest, truth.end()); });
  std::uint64_t before = 0;
  for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
    Motion run(bar_with(stage("solvers.implicit", {{"end_time", end}, {"tolerance", tolerance}})));
    run.go();
    const double error = std::abs(run.end() - truth.end()) / farthest;
    std::printf("tolerance %.0e: %llu steps (explicit %llu), error %.1e\n", tolerance,
                static_cast<unsigned long long>(run.simulation.steps()),
                static_cast<unsigned long long>(truth.simulation.steps()), error);
    EXPECT_LT(error, 30 * tolerance);
    EXPECT_LT(run.simulation.steps(), truth.simulation.steps() / 10);
    EXPECT_GT(run.simulation.steps(), before);
    before = run.simulation.steps();
  }
}

TEST(Implicit, GivesTheSameBitsOnAnyNumberOfThreads) {
  const auto hash = [](int threads) {
    Motion run(
        SceneBuilder{}
            .lattice("lattices.cubic", 1e-3, box_mm(42, 40, 40))
            .material("materials.elastic", {{"young", 1e9}, {"poisson", 0.3}, {"density", 1000}})
            .stage("loads.fixed", {{"on", "x_min"}})
            .stage("loads.gravity", {{"acceleration", {1000, 500, 0}}})
            .stages(implicit_to(4e-5, 2e-5, {{"residual", 1e-3}}))
            .text(),
        threads);
    run.go();
    return run.simulation.hash();
  };
  EXPECT_EQ(hash(1), hash(3));
}

TEST(Implicit, LoadsAnswerToTheMeanMotion) {
  // A block that falls on a floor and jumps off again, in steps of several critical ones.
  const auto falling = [](const Stages& solver) {
    return SceneBuilder{}
        .lattice("lattices.cubic", 1e-3, box_mm(5, 4, 4))
        .material("materials.elastic", {{"young", 1e7}, {"poisson", 0.25}, {"density", 1000}})
        .stage("loads.start_velocity", {{"linear", {0, 0, -1}}})
        .stage("loads.floor", {{"point", {0, 0, -2e-4}}, {"normal", {0, 0, 1}}})
        .stages(solver)
        .text();
  };
  constexpr double end = 4e-4;
  Motion truth(falling(stage("solvers.explicit", {{"end_time", end}, {"safety", 0.2}})));
  truth.go();
  const double whole = truth.simulation.balance().momentum.z;
  double last = 0;
  for (const double step : {3.2e-5, 1.6e-5, 8e-6}) {
    Motion run(falling(implicit_to(end, step)));
    double largest = 0;
    run.go(
        [&] { largest = std::max(largest, std::abs(run.simulation.balance().relative_error())); });
    last = std::abs(run.simulation.balance().momentum.z / whole - 1);
    std::printf("step %.1f critical: momentum after the jump within %.1e, balance %.1e\n",
                step / run.critical(), last, largest);
    EXPECT_LT(largest, 1e-6);
    EXPECT_LT(last, 0.05);
  }
  EXPECT_LT(last, 0.01);
}

TEST(Implicit, FollowerForcesActInTheMeanDirection) {
  // A free bar whose middle is driven apart on one side: it bends and turns.
  const auto robot = [](const Stages& solver) {
    return SceneBuilder{}
        .lattice("lattices.cubic", 1e-3, box_mm(16, 3, 3))
        .material("materials.elastic", {{"young", 1e7}, {"poisson", 0.25}, {"density", 1000}})
        .region("muscle", box({0.006, 0, 0}, {0.010, 0.001, 0.003}))
        .stage("loads.actuation", {{"on", "muscle"},
                                   {"force", 0.5},
                                   {"form", "triangle"},
                                   {"rise", 2e-3},
                                   {"fall", 2e-3}})
        .stages(solver)
        .text();
  };
  constexpr double end = 4e-3;
  Motion truth(robot(stage("solvers.explicit", {{"end_time", end}, {"safety", 0.5}})));
  truth.go();
  const std::vector<double> u = displacements(truth.simulation);
  double before = 0;
  for (const double step : {1e-4, 5e-5}) {
    Motion run(robot(implicit_to(end, step, {{"residual", 1e-8}})));
    run.go();
    const std::vector<double> found = displacements(run.simulation);
    double error = 0;
    for (std::size_t n = 0; n < u.size(); ++n) error = std::max(error, std::abs(found[n] - u[n]));
    const EnergyBalance now = run.simulation.balance();
    std::printf("step %.1f critical: %.2e of %.2e m, momentum %.1e, balance %.1e\n",
                step / run.critical(), error, largest(u), norm(now.momentum), now.relative_error());
    EXPECT_LT(error, 0.15 * largest(u));
    EXPECT_LT(std::abs(now.relative_error()), 1e-5);
    if (before > 0) {
      EXPECT_GT(before / error, 2.5);
    }
    before = error;
  }
}

TEST(Implicit, NamesALoadThatIsNoNumberWithinAStep) {
  Motion run(
      SceneBuilder{}
          .lattice("lattices.cubic", 1e-3, box_mm(4, 3, 3))
          .material("materials.elastic", {{"young", 1e9}, {"poisson", 0.25}, {"density", 1000}})
          .stage("loads.expression",
                 {{"on", "all"}, {"total", {1, 0, 0}}, {"expression", "sqrt(0.00105 - t)"}})
          .stages(implicit_to(2e-3, 1e-4))
          .text());
  try {
    run.go();
    FAIL();
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("loads.expression"), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("0.001 s"), std::string::npos) << error.what();
  }
}

TEST(Implicit, RefusesWhatItCannotDo) {
  const auto fault = [](const std::string& lattice, const Keys& material, const Keys& more = {}) {
    try {
      plan_of(SceneBuilder{}
                  .lattice(lattice, 1e-3, box_mm(5, 4, 4), more)
                  .material("materials.elastic", Keys{{"young", 1e9}, {"density", 1000}} + material)
                  .stages(implicit_to(1e-3, 1e-4))
                  .text());
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto expect = [&](const std::string& found, const char* sentence) {
    EXPECT_NE(found.find(sentence), std::string::npos) << found;
  };
  expect(fault("lattices.random", {{"poisson", 0.4}}, {{"sample", 8}}),
         "a list without nodal volumes");
}

}  // namespace implicit_test
