// Local steps: stiff particles take several steps within one step of the others. Against equal
// short steps: order, stability, momentum, energy, loads and failure; bits on any threads.
#include <base/errors.hpp>
#include <support/motion.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace local_steps_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

struct Bar {
  double contrast = 100;
  Stages loads{};
  double end = 6e-5;
  Keys solver{}, soft{}, stiff{}, scene{};
};

/// A bar along x of 24 x 3 x 3 particles with a stiff layer, whose soft waves take 1 us a cell.
std::string text_of(const Bar& bar) {
  const Keys elastic{{"young", 1e9}, {"density", 1000}, {"poisson", 0.25}};
  SceneBuilder scene;
  for (const auto& [key, value] : bar.scene.json().items()) scene.key(key, value);
  return scene.lattice("lattices.cubic", 1e-3, box_mm(24, 3, 3))
      .material("materials.elastic", elastic + bar.soft)
      .material("materials.elastic", elastic +
                                         Keys{{"name", "stiff"},
                                              {"region", box({9.9e-3, -1, -1}, {13.1e-3, 1, 1})},
                                              {"young", 1e9 * bar.contrast}} +
                                         bar.stiff)
      .stages(bar.loads)
      .solver("solvers.explicit", Keys{{"end_time", bar.end}} + bar.solver)
      .text();
}

Keys parts(int number) { return {{"local_steps", number}}; }

/// A push along x on the left face that begins and ends smoothly.
Stages push() {
  return stage("loads.expression",
               {{"on", "x_min"},
                {"total", {2, 0, 0}},
                {"expression", "t < 20e-6 ? 0.5 * (1 - cos(2 * pi * t / 20e-6)) : 0"},
                {"corners", {2e-5}}});
}

TEST(LocalSteps, AreOfSecondOrder) {
  Motion truth(text_of({.loads = push(), .solver = {{"safety", 0.2}}}));
  truth.go();
  const std::vector<double> u = displacements(truth.simulation);
  double before = 0;
  for (const double step : {6e-7, 3e-7, 1.5e-7}) {
    Motion run(text_of({.loads = push(), .solver = parts(10) + Keys{{"time_step", step}}}));
    run.go();
    const double error = distance(displacements(run.simulation), u) / largest(u);
    std::printf("step %.2e s (%.2f critical): error %.2e, balance %.1e\n", step,
                step / run.critical(), error, run.simulation.balance().relative_error());
    EXPECT_GT(step, 0.9 * run.critical());
    if (before > 0) {
      EXPECT_GT(before / error, 3);
    }
    before = error;
  }
  EXPECT_LT(before, 2e-3);
}

class Contrast : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Stiff, Contrast, testing::Values(1e1, 1e2, 1e4, 1e6));

TEST_P(Contrast, StaysStableAndKeepsMomentum) {
  Motion run(text_of({.contrast = GetParam(),
                      .end = 1e-3,
                      .solver = parts(static_cast<int>(std::ceil(std::sqrt(GetParam()))))}));
  const PlannedStage& stage = run.plan->stages.front();
  EXPECT_GT(stage.plan.time_step, 0.6 * std::sqrt(GetParam()) * run.critical());
  Simulation& simulation = run.simulation;
  const std::size_t particles = run.model().body.particles;
  simulation.set_velocities(noise(3 * particles, 1e-3, 3), {});
  const Vec3 momentum = simulation.balance().momentum;
  double first = 0, second = 0;  // largest energies in both halves of the run
  run.go([&] {
    const EnergyBalance now = simulation.balance();
    double& largest = simulation.time() < 0.5 * stage.plan.end_time ? first : second;
    largest = std::max(largest, now.kinetic + now.stored);
  });
  const EnergyBalance end = simulation.balance();
  std::printf(
      "contrast %.0e: %llu steps of %.1f critical, energy of the second half %.3f of the first\n",
      GetParam(), static_cast<unsigned long long>(simulation.steps()),
      stage.plan.time_step / run.critical(), second / first);
  EXPECT_GT(first, 0);
  EXPECT_LT(second, 1.3 * first);
  EXPECT_LT(norm(end.momentum - momentum), 1e-9 * std::sqrt(end.kinetic_mean));
}

TEST(LocalSteps, LoadsAndSupportsOfStiffParticlesAct) {
  // A weight and a support on the stiff layer: the body comes to the same places.
  const Stages loads = stage("loads.fixed", {{"on", box({11.4e-3, -1, -1}, {11.6e-3, 1, 1})}}) +
                       stage("loads.gravity", {{"acceleration", {1000, 200, 0}}}) +
                       stage("loads.force", {{"on", box({10.4e-3, -1, -1}, {10.6e-3, 1, 1})},
                                             {"total", {-3, 0, 0}},
                                             {"rise", 2e-5}});
  Motion truth(text_of({.contrast = 1e4, .loads = loads}));
  Motion run(text_of({.contrast = 1e4, .loads = loads, .solver = {{"local_steps", "auto"}}}));
  EXPECT_GT(run.plan->stages.front().plan.local.parts, 50);
  truth.go();
  run.go();
  const std::vector<double> u = displacements(truth.simulation);
  const double error = distance(displacements(run.simulation), u) / largest(u);
  std::printf("%llu steps, short ones %llu: error %.2e, balance %.1e\n",
              static_cast<unsigned long long>(run.simulation.steps()),
              static_cast<unsigned long long>(truth.simulation.steps()), error,
              run.simulation.balance().relative_error());
  EXPECT_LT(error, 5e-3);
}

TEST(LocalSteps, SpringsBreakAsWithShortSteps) {
  const auto failure = [](double limit) {
    return Keys{{"failure", {{"type", "failures.strain"}, {"limit", limit}}}};
  };
  struct Found {
    double time = 0, count = 0;
    Vec3 place;
  };
  const auto broken = [&](const Keys& solver) {
    Motion run(text_of({.loads = push() + stage("loads.fixed", {{"on", "x_max"}}),
                        .solver = solver,
                        .soft = failure(1.5e-4),
                        .stiff = failure(1.0)}));
    run.go();
    const std::vector<Breakage>& all = run.simulation.breakages();
    EXPECT_FALSE(all.empty());
    if (all.empty()) return Found{};
    return Found{all.front().time, static_cast<double>(all.size()),
                 run.model().body.position(all.front().a)};
  };
  const Found truth = broken({{"time_step", 2e-8}}),
              found = broken(parts(10) + Keys{{"time_step", 2e-7}});
  std::printf("%g springs from %.3e s, with short steps %g from %.3e s\n", found.count, found.time,
              truth.count, truth.time);
  EXPECT_NEAR(found.time, truth.time, 4e-7);
  EXPECT_NEAR(found.count, truth.count, 0.2 * truth.count);
  EXPECT_NEAR(found.place.x, truth.place.x, 1.1e-3);
}

TEST(LocalSteps, GiveTheSameBitsOnAnyThreadsAndReturnTheirSprings) {
  const auto run_on = [](int threads) {
    Motion run(text_of({.loads = push(), .solver = parts(10)}), threads);
    run.go();
    EXPECT_EQ(run.simulation.broken(), 0U);
    return run.simulation.hash();
  };
  const std::uint64_t one = run_on(1);
  EXPECT_EQ(run_on(2), one);
  EXPECT_EQ(run_on(3), one);
}

TEST(LocalSteps, BreakTheSameOnAnyThreadsAndAfterANewStart) {
  // Springs of the stiff layer itself break, too.
  const Keys brittle = {{"failure", {{"type", "failures.strain"}, {"limit", 1.5e-4}}}};
  const auto text = [&](const Stages& more) {
    SceneBuilder scene(text_of({.contrast = 4,
                                .loads = push() + stage("loads.fixed", {{"on", "x_max"}}),
                                .end = 4e-5,
                                .solver = parts(2) + Keys{{"time_step", 2e-7}},
                                .soft = brittle,
                                .stiff = brittle}));
    return scene.stages(more).text();
  };
  const Stages rest =
      stage("solvers.explicit", parts(2) + Keys{{"end_time", 6e-5}, {"time_step", 2e-7}});
  const auto run_on = [&](int threads) {
    Motion run(text(rest), threads);
    run.go();
    EXPECT_GT(run.simulation.broken(), 0U);
    EXPECT_LT(std::abs(run.simulation.balance().relative_error()), 0.02);
    return run.simulation.hash();
  };
  const std::uint64_t one = run_on(1);
  EXPECT_EQ(run_on(2), one);
  EXPECT_EQ(run_on(3), one);
}

TEST(LocalSteps, InFloats) {
  const auto end = [](const Keys& scene) {
    Motion run(text_of({.loads = push(), .solver = parts(10), .scene = scene}));
    run.go();
    return displacements(run.simulation);
  };
  const std::vector<double> doubles = end({}), floats = end({{"precision", "float"}});
  EXPECT_LT(distance(doubles, floats), 1e-4 * largest(doubles));
  EXPECT_GT(distance(doubles, floats), 0);
}

TEST(LocalSteps, RefuseWhatTheyCannotDo) {
  const auto fault = [](const Keys& soft, const Keys& solver) {
    try {
      plan_of(text_of({.solver = solver, .soft = soft}));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(fault({{"poisson", 0.4}}, parts(4)).find("volumetric"), std::string::npos);
  EXPECT_NE(fault({}, parts(4) + Keys{{"damping", 0.1}}).find("local_steps"), std::string::npos);
  EXPECT_EQ(fault({{"poisson", 0.4}}, {}), "");
}

}  // namespace local_steps_test
