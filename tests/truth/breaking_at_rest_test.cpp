// Springs that break in states of rest: the load at which they do, the force that the rest of the
// body carries, energy, and results that do not depend on the number of load steps.
#include <base/errors.hpp>
#include <support/motion.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace breaking_at_rest_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr double young = 1e9, pull = 3e-3;  // Pa; the bar's strain at the end
constexpr int length = 8, width = 2;        // mm

Stages elastic(double limit, const Keys& more = {}) {
  return stage("materials.elastic",
               Keys{{"young", young},
                    {"poisson", 0.25},
                    {"density", 1000},
                    {"failure", {{"type", "failures.strain"}, {"limit", limit}}}} +
                   more);
}

/// Two bars along x that share no springs, of materials with these limits, pulled together.
std::string two_bars(double first, double second, const Stages& loads, const Keys& solver = {}) {
  const Json lower = box_mm(length, width, width),
             upper = box({0, mm(2 * width), 0}, {mm(length), mm(3 * width), mm(width)});
  return SceneBuilder{}
      .lattice("lattices.cubic", 1e-3, {{"union", {lower, upper}}}, {{"boundary", "cells"}})
      .stages(elastic(first))
      .stages(elastic(second, {{"name", "upper"}, {"region", upper}}))
      .stage("loads.fixed", {{"on", "x_min"}, {"axes", "x"}})
      .stage("loads.fixed", {{"on", box({-1, -1e-9, -1}, {1, 1e-9, 1})}, {"axes", "y"}})
      .stage("loads.fixed", {{"on", box({-1, 3.9e-3, -1}, {1, 4.1e-3, 1})}, {"axes", "y"}})
      .stage("loads.fixed", {{"on", "z_min"}, {"axes", "z"}})
      .stages(loads)
      .solver("solvers.static", Keys{{"end_time", 1}, {"tolerance", 1e-9}} + solver)
      .text();
}

Stages displaced() {
  return stage("loads.displacement",
               {{"on", "x_max"}, {"axes", "x"}, {"value", {pull * mm(length), 0, 0}}, {"rise", 1}});
}

TEST(BreakingAtRest, BarsBreakAtTheirLimitsInAnyNumberOfLoadSteps) {
  constexpr double weak = 1e-3, strong = 2e-3;
  const double area = mm(width) * mm(width);
  for (const int steps : {1, 7, 64}) {
    Motion run(two_bars(weak, strong, displaced(), {{"load_steps", steps}}));
    double largest = 0;
    run.go([&] {
      Simulation& simulation = run.simulation;
      const double strain = simulation.time() * pull;
      const int whole = simulation.broken() == 0 ? 2 : strain < strong ? 1 : 0;
      const std::vector<Vec3> forces = simulation.force_on_load();
      EXPECT_NEAR(forces.back().x, whole * young * area * strain,
                  2e-3 * young * area * strain + 1e-9)
          << steps << " steps, at " << simulation.time() << " s";
      largest = std::max(largest, std::abs(simulation.balance().relative_error()));
    });
    const std::vector<Breakage>& broken = run.simulation.breakages();
    ASSERT_FALSE(broken.empty());
    EXPECT_NEAR(broken.front().time, weak / pull, 1.1e-3 * weak / pull) << steps << " steps";
    EXPECT_NEAR(broken.back().time, strong / pull, 1.1e-3 * strong / pull) << steps << " steps";
    std::printf("%d steps: %zu springs from %.6f to %.6f s, balance %.1e\n", steps, broken.size(),
                broken.front().time, broken.back().time, largest);
    EXPECT_LT(largest, 1e-6);
    const EnergyBalance end = run.simulation.balance();
    EXPECT_NEAR(end.dissipated(), 0.5 * young * area * mm(length) * (weak * weak + strong * strong),
                3e-3 * end.dissipated());
    EXPECT_LT(end.stored, 1e-12 * end.dissipated());
  }
}

TEST(BreakingAtRest, ATornBodyUnderAForceHasNoRest) {
  const double force = 2 * young * mm(width) * mm(width) * 1.5e-3;
  Motion run(two_bars(
      1e-3, 2e-3, stage("loads.force", {{"on", "x_max"}, {"total", {force, 0, 0}}, {"rise", 1}})));
  try {
    run.go();
    FAIL();
  } catch (const RunError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("broke"), std::string::npos) << text;
    EXPECT_NE(text.find("66.7% of the load"), std::string::npos) << text;
  }
  EXPECT_GT(run.simulation.broken(), 0U);
}

/// A plate with a notch at its left side, pulled apart.
std::string notched(const Keys& solver) {
  return SceneBuilder{}
      .lattice("lattices.cubic", 1e-3,
               {{"difference", {box_mm(16, 16, 2), box({-1, 7.6e-3, -1}, {5.2e-3, 8.4e-3, 1})}}},
               {{"boundary", "cells"}})
      .stages(elastic(1e-3))
      .stage("loads.fixed", {{"on", "y_min"}})
      .stage("loads.displacement",
             {{"on", "y_max"}, {"axes", "xyz"}, {"value", {0, 2e-5, 0}}, {"rise", 1}})
      .solver("solvers.static", Keys{{"end_time", 1}} + solver)
      .text();
}

TEST(BreakingAtRest, ACrackRunsThroughANotchedPlate) {
  std::size_t before = 0;
  for (const int steps : {10, 40}) {
    Motion run(notched({{"load_steps", steps}}));
    double peak = 0, last = 0, largest = 0;
    run.go([&] {
      last = run.simulation.force_on_load().back().y;
      peak = std::max(peak, last);
      largest = std::max(largest, std::abs(run.simulation.balance().relative_error()));
    });
    const std::vector<Breakage>& broken = run.simulation.breakages();
    std::printf("%d steps: %zu broken, first at %.5f s, peak %.4f N, last %.2e N, balance %.1e\n",
                steps, broken.size(), broken.front().time, peak, last, largest);
    EXPECT_GT(peak, 0);
    EXPECT_LT(std::abs(last), 1e-6 * peak);
    EXPECT_LT(largest, 1e-4);
    // The crack begins at the notch.
    const Vec3 first = run.model().body.position(broken.front().a);
    EXPECT_NEAR(first.x, 5.5e-3, 1.1e-3);
    if (before > 0) EXPECT_NEAR(static_cast<double>(broken.size()), static_cast<double>(before), 3);
    before = broken.size();
  }
}

TEST(BreakingAtRest, GivesTheSameBitsOnAnyNumberOfThreads) {
  const auto hash = [](int threads) {
    Motion run(notched({{"load_steps", 4}}), threads);
    run.go();
    return run.simulation.hash();
  };
  const std::uint64_t one = hash(1);
  EXPECT_EQ(hash(2), one);
  EXPECT_EQ(hash(3), one);
}

TEST(BreakingAtRest, ListsBreakToo) {
  Motion run(SceneBuilder{}
                 .lattice("lattices.random", 1e-3, box_mm(10, 5, 5), {{"coordination", 13.2}})
                 .stages(elastic(2e-3))
                 .stage("loads.fixed", {{"on", "x_min"}})
                 .stage("loads.displacement",
                        {{"on", "x_max"}, {"axes", "x"}, {"value", {1e-4, 0, 0}}, {"rise", 1}})
                 .solver("solvers.static", {{"end_time", 1}, {"load_steps", 5}})
                 .text());
  double peak = 0, last = 0;
  run.go([&] {
    last = run.simulation.force_on_load().back().x;
    peak = std::max(peak, last);
  });
  std::printf("%llu broken, peak %.3f N, last %.2e N, balance %.1e\n",
              static_cast<unsigned long long>(run.simulation.broken()), peak, last,
              run.simulation.balance().relative_error());
  EXPECT_GT(run.simulation.broken(), 0U);
  EXPECT_LT(std::abs(last), 0.2 * peak);
  EXPECT_LT(std::abs(run.simulation.balance().relative_error()), 1e-3);
}

}  // namespace breaking_at_rest_test
