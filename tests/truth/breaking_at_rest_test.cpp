// Springs that break in states of rest: the load at which they do, the force that the rest of the
// body carries, energy, and results that do not depend on the number of load steps.
#include <base/errors.hpp>
#include <support/motion.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace breaking_at_rest_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr double young = 1e9, pull = 3e-3;  // Pa; strain of the chains at the end
constexpr int length = 8;                   // mm

Stages elastic(double limit, const Keys& more = {}) {
  return stage("materials.elastic",
               Keys{{"young", young},
                    {"density", 1000},
                    {"failure", {{"type", "failures.strain"}, {"limit", limit}}}} +
                   more);
}
const Keys quarter{{"poisson", 0.25}};

/// Two chains of particles along x, pulled together. Each has a particle whose springs have its
/// limit.
std::string two_chains(double first, double second, const Stages& loads, const Keys& solver = {}) {
  const auto row = [](double from, double to, int y) {
    return box({from, mm(y), 0}, {to, mm(y + 1), mm(1)});
  };
  const auto weak = [&](const char* name, double limit, int y) {
    return elastic(limit, quarter + Keys{{"name", name}, {"region", row(3e-3, 4e-3, y)}});
  };
  return SceneBuilder{}
      .lattice("lattices.cubic", 1e-3, {{"union", {row(0, mm(length), 0), row(0, mm(length), 3)}}})
      .stages(elastic(1e-1, quarter))
      .stages(weak("first", first, 0))
      .stages(weak("second", second, 3))
      .stage("loads.fixed", {{"on", "all"}, {"axes", "yz"}})
      .stage("loads.fixed", {{"on", "x_min"}, {"axes", "x"}})
      .stages(loads)
      .solver("solvers.static", Keys{{"end_time", 1}, {"tolerance", 1e-9}} + solver)
      .text();
}

Stages displaced() {
  return stage(
      "loads.displacement",
      {{"on", "x_max"}, {"axes", "x"}, {"value", {pull * mm(length - 1), 0, 0}}, {"rise", 1}});
}

TEST(BreakingAtRest, ChainsBreakAtTheirLimitsInAnyNumberOfLoadSteps) {
  constexpr double weak = 1e-3, strong = 2e-3;
  // A spring of the lattice without a membrane has k = 2/5 E l (docs/theory/calibration.md).
  const double stiffness = 0.4 * young * 1e-3 / (length - 1);  // of a chain, N/m
  for (const int steps : {1, 7, 64}) {
    Motion run(two_chains(weak, strong, displaced(), {{"load_steps", steps}}));
    double largest = 0;
    run.go([&] {
      Simulation& simulation = run.simulation;
      const double strain = simulation.time() * pull;
      const int whole = simulation.broken() == 0 ? 2 : strain < strong ? 1 : 0;
      const double one = stiffness * strain * mm(length - 1);
      EXPECT_NEAR(-simulation.force_on_load().back().x, whole * one, 1e-6 * one + 1e-12)
          << steps << " steps, at " << simulation.time() << " s";
      largest = std::max(largest, std::abs(simulation.balance().relative_error()));
    });
    const std::vector<Breakage>& broken = run.simulation.breakages();
    ASSERT_EQ(broken.size(), 4U);  // two springs of each weak particle
    EXPECT_NEAR(broken.front().time, weak / pull, 1.1e-3 * weak / pull) << steps << " steps";
    EXPECT_NEAR(broken.back().time, strong / pull, 1.1e-3 * strong / pull) << steps << " steps";
    EXPECT_LT(largest, 1e-9);
    const EnergyBalance end = run.simulation.balance();
    EXPECT_NEAR(end.dissipated(),
                0.5 * stiffness * std::pow(mm(length - 1), 2) * (weak * weak + strong * strong),
                3e-3 * end.dissipated());
    EXPECT_LT(end.stored, 1e-12 * end.dissipated());
  }
}

TEST(BreakingAtRest, ATornBodyUnderAForceHasNoRest) {
  const double force = 2 * 0.4 * young * 1e-6 * 1.5e-3;
  Motion run(two_chains(
      1e-3, 2e-3, stage("loads.force", {{"on", "x_max"}, {"total", {force, 0, 0}}, {"rise", 1}})));
  try {
    run.go();
    FAIL();
  } catch (const RunError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("springs broke"), std::string::npos) << text;
    EXPECT_NE(text.find("66.7"), std::string::npos) << text;
  }
  EXPECT_EQ(run.simulation.broken(), 2U);
}

/// A plate with a notch at its left side, pulled apart.
std::string notched(const Keys& solver) {
  return SceneBuilder{}
      .lattice("lattices.cubic", 1e-3,
               {{"difference", {box_mm(16, 16, 2), box({-1, 7e-3, -1}, {5e-3, 8e-3, 1})}}},
               {{"boundary", "cells"}})
      .stages(elastic(1e-3, quarter))
      .stage("loads.fixed", {{"on", "y_min"}, {"axes", "y"}})
      .stage("loads.fixed", {{"on", "z_min"}, {"axes", "z"}})
      .stage("loads.fixed", {{"on", "x_max"}, {"axes", "x"}})
      .stage("loads.displacement",
             {{"on", "y_max"}, {"axes", "y"}, {"value", {0, 3e-5, 0}}, {"rise", 1}})
      .solver("solvers.static", Keys{{"end_time", 1}} + solver)
      .text();
}

TEST(BreakingAtRest, ACrackRunsThroughANotchedPlate) {
  std::size_t before = 0;
  for (const int steps : {10, 40}) {
    Motion run(notched({{"load_steps", steps}}));
    double peak = 0, last = 0, largest = 0;
    run.go([&] {
      last = -run.simulation.force_on_load().back().y;
      peak = std::max(peak, last);
      largest = std::max(largest, std::abs(run.simulation.balance().relative_error()));
    });
    const std::vector<Breakage>& broken = run.simulation.breakages();
    std::printf("%d steps: %zu broken, first at %.5f s, peak %.4f N, last %.2e N, balance %.1e\n",
                steps, broken.size(), broken.front().time, peak, last, largest);
    EXPECT_GT(peak, 0);
    EXPECT_LT(std::abs(last), 0.02 * peak);  // some loose ends still hang on springs
    EXPECT_LT(largest, 1e-4);
    // The crack begins at the notch.
    const Vec3 first = run.model().body.position(broken.front().a);
    EXPECT_NEAR(first.x, 5.5e-3, 1.1e-3);
    if (before > 0) {
      EXPECT_NEAR(static_cast<double>(broken.size()), static_cast<double>(before), 3);
    }
    before = broken.size();
  }
}

TEST(BreakingAtRest, LoadsFallAlongASnapBack) {
  // Held loads set free what their further way gives. Loads that fall set free only what a spring
  // that breaks takes from its surroundings.
  double set_free[2] = {}, of_springs[2] = {};
  for (const bool falls : {false, true}) {
    Motion run(notched({{"load_steps", 10}, {"snap_back", falls}}));
    double latest = 0, fallen = 0, largest = 0;
    run.go([&] {
      latest = std::max(latest, run.simulation.time());
      fallen = std::max(fallen, latest - run.simulation.time());
      largest = std::max(largest, std::abs(run.simulation.balance().relative_error()));
    });
    const EnergyBalance end = run.simulation.balance();
    set_free[falls] = end.dissipated_damping;
    of_springs[falls] = end.dissipated_failure;
    std::printf(
        "%s: set free %.3e J, springs %.3e J, %llu broken, time fell by %.3f s, balance %.1e\n",
        falls ? "falls" : "held", set_free[falls], of_springs[falls],
        static_cast<unsigned long long>(run.simulation.broken()), fallen, largest);
    EXPECT_LT(largest, 1e-3);
    EXPECT_EQ(fallen > 0.1, falls);
  }
  EXPECT_LT(set_free[1], 0.6 * set_free[0]);
  EXPECT_LT(of_springs[1], of_springs[0]);
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
    last = -run.simulation.force_on_load().back().x;
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
