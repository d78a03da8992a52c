// Springs that break at the ends of implicit steps: the same failures as with explicit steps,
// however long the steps are, and energy.
#include <support/motion.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace breaking_implicit_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

/// A bar of 1 m/ms wave speed with a weak layer, pulled at its end at a constant speed, m/s.
std::string bar(double speed, const Stages& solver) {
  const auto material = [](double limit, const Keys& more = {}) {
    return stage("materials.elastic",
                 Keys{{"young", 1e9},
                      {"poisson", 0.25},
                      {"density", 1000},
                      {"failure", {{"type", "failures.strain"}, {"limit", limit}}}} +
                     more);
  };
  return SceneBuilder{}
      .lattice("lattices.cubic", 1e-3, box_mm(12, 2, 2), {{"boundary", "cells"}})
      .stages(material(1e-2))
      .stages(material(1e-3, {{"name", "weak"}, {"region", box({5.5e-3, -1, -1}, {6.5e-3, 1, 1})}}))
      .stage("loads.fixed", {{"on", "x_min"}})
      .stage("loads.velocity", {{"on", "x_max"}, {"axes", "x"}, {"value", {speed, 0, 0}}})
      .stages(solver)
      .text();
}

struct Outcome {
  double time = 0;  ///< of the first failure, s
  std::set<std::pair<Particle, Particle>> springs;
  double balance = 0;
  std::uint64_t steps = 0;
};
Outcome outcome(const std::string& scene) {
  Motion run(scene);
  Outcome found;
  run.go([&] {
    found.balance = std::max(found.balance, std::abs(run.simulation.balance().relative_error()));
  });
  for (const Breakage& broken : run.simulation.breakages())
    found.springs.emplace(broken.a, broken.b);
  if (!found.springs.empty()) found.time = run.simulation.breakages().front().time;
  found.steps = run.simulation.steps();
  return found;
}

TEST(BreakingImplicit, ASlowlyPulledBarBreaksAsInExplicitSteps) {
  constexpr double speed = 0.05, end = 4e-4;  // twelve wave times to the first failure
  const Outcome truth = outcome(bar(speed, stage("solvers.explicit", {{"end_time", end}})));
  ASSERT_FALSE(truth.springs.empty());
  for (const double step : {2e-6, 1e-5, 5e-5}) {
    const Outcome found =
        outcome(bar(speed, stage("solvers.implicit",
                                 {{"end_time", end}, {"time_step", step}, {"residual", 1e-8}})));
    std::printf(
        "step %.0e s: %llu steps (explicit %llu), first failure at %.5e s (%.5e), "
        "%zu springs (%zu), balance %.1e\n",
        step, static_cast<unsigned long long>(found.steps),
        static_cast<unsigned long long>(truth.steps), found.time, truth.time, found.springs.size(),
        truth.springs.size(), found.balance);
    EXPECT_NEAR(found.time, truth.time, 0.03 * truth.time);
    EXPECT_EQ(found.springs, truth.springs);
    EXPECT_LT(found.balance, 1e-4);
  }
}

TEST(BreakingImplicit, AShockBreaksTheSameSpringsInStepsOfTheCriticalOne) {
  constexpr double speed = 2, end = 3e-5;
  const Outcome truth = outcome(bar(speed, stage("solvers.explicit", {{"end_time", end}})));
  const Outcome found =
      outcome(bar(speed, stage("solvers.implicit",
                               {{"end_time", end}, {"time_step", 2e-7}, {"residual", 1e-8}})));
  std::printf("%zu springs, explicit %zu, first at %.3e and %.3e s\n", found.springs.size(),
              truth.springs.size(), found.time, truth.time);
  ASSERT_FALSE(truth.springs.empty());
  EXPECT_EQ(found.springs, truth.springs);
  EXPECT_NEAR(found.time, truth.time, 4e-7);
}

}  // namespace breaking_implicit_test
