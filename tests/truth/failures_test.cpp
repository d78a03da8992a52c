// Failure criteria against counts by hand. A body is strained evenly, so that the elongation of
// every spring is known, and takes one step.
#include <support/lists.hpp>
#include <support/models.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <set>

namespace failures_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

/// The key of a criterion of failure.
Keys failing(const std::string& criterion, const Keys& keys) {
  return {{"failure", (Keys{{"type", "failures." + criterion}} + keys).json()}};
}
Keys breakable(const std::string& criterion, const Keys& keys) {
  return Keys{{"poisson", 0.25}} + failing(criterion, keys);
}

/// Displacements (strain x + shear y, 0, 0).
std::vector<double> strained(const Model& model, double strain, double shear) {
  std::vector<double> u;
  for (Particle p = 0; p < model.body.particles; ++p) {
    const Vec3 x = model.body.position(p);
    u.insert(u.end(), {strain * x.x + shear * x.y, 0, 0});
  }
  return u;
}

using Spring = std::pair<Particle, Particle>;
/// Compares the springs that break in one step after this deformation with the springs that pass
/// the test `by_hand` (rest length, elongation, ends).
void compare(const Plan& plan, double strain, double shear,
             const std::function<bool(double, double, Spring)>& by_hand, std::size_t at_least) {
  const Model& model = *plan.model;
  const std::vector<double> u = strained(model, strain, shear);
  const auto place = [&](Particle p) {
    return model.body.position(p) + Vec3{u[3 * p], u[3 * p + 1], u[3 * p + 2]};
  };
  std::set<Spring> expected, found;
  model.body.for_springs([&](Particle a, Particle b, std::uint32_t) {
    const double rest = norm(model.body.position(b) - model.body.position(a)),
                 now = norm(place(b) - place(a));
    if (by_hand(rest, now - rest, {std::min(a, b), std::max(a, b)}))
      expected.insert({std::min(a, b), std::max(a, b)});
  });
  for (const int threads : {1, 3}) {
    Simulation simulation(model, threads);
    simulation.set_displacements(u, {});
    simulation.step(1e-3 * model.step_limit.time_step);
    found.clear();
    for (const Breakage& breakage : simulation.breakages())
      found.insert({std::min(breakage.a, breakage.b), std::max(breakage.a, breakage.b)});
    EXPECT_EQ(found, expected) << threads << " threads";
  }
  EXPECT_GE(expected.size(), at_least);
  EXPECT_LT(expected.size(), model.body.base_springs() + model.body.listed.springs.size());
}

constexpr double l = 1e-3, k = 0.4 * 1e10 * l;  // as in block(), nu = 1/4

TEST(Failures, StrainCountsSpringsByTheirLength) {
  const auto plan = plan_of(block(5, 4, 6, breakable("strain", {{"limit", 0.008}})));
  compare(
      *plan, 0.01, 0.004,
      [](double rest, double elongation, Spring) { return elongation > 0.008 * rest; }, 50);
  const ListFiles files(5, 4, 6);
  const auto list = plan_of(listed_scene(
      files.lattice(), Keys{{"membrane", "none"}} + failing("strain", {{"limit", 0.005}})));
  compare(
      *list, 0.01, 0,
      [](double rest, double elongation, Spring) { return elongation > 0.005 * rest; }, 50);
}

TEST(Failures, ForceCountsByTheStiffness) {
  // The limit is reached at 8.75 um.
  const auto plan = plan_of(block(5, 4, 6, breakable("force", {{"limit", 35}})));
  compare(
      *plan, 0.01, 0.004, [](double, double elongation, Spring) { return k * elongation > 35; },
      50);
}

TEST(Failures, EnergyCountsInTensionOnly) {
  // The limit is reached at 7.07 um.
  const auto plan = plan_of(block(5, 4, 6, breakable("energy", {{"limit", 1e-4}})));
  compare(
      *plan, 0.01, 0.02,
      [](double, double elongation, Spring) {
        return elongation > 0 && 0.5 * k * elongation * elongation > 1e-4;
      },
      50);
}

TEST(Failures, FractureEnergyIsThatOfTheSpringsThroughAnArea) {
  const double crossings = (3 + 6 * std::sqrt(2.0)) / (2 * l * l);
  const auto plan = plan_of(block(5, 4, 6, breakable("energy", {{"fracture_energy", 500}})));
  EXPECT_NEAR(plan->model->springs.crossings, crossings, 1e-12 * crossings);
  compare(
      *plan, 0.01, 0.004,
      [&](double, double elongation, Spring) {
        return elongation > 0 && 0.5 * k * elongation * elongation > 500 / crossings;
      },
      50);
  // The independent count: springs of a block that cross a unit area of planes in many directions.
  const auto body = build(box_lattice(24, 24, 24) + "," + elastic());
  double mean = 0;
  int planes = 0;
  for (int n = 0; n < 200; ++n) {  // Fibonacci's points on the sphere
    const double z = 1 - (2 * n + 1) / 200.0, angle = 2.399963229728653 * n;
    const Vec3 normal{std::sqrt(1 - z * z) * std::cos(angle),
                      std::sqrt(1 - z * z) * std::sin(angle), z};
    double crossing = 0;
    // In a unit of volume, one spring of each kind begins.
    for (const NeighbourGeometry& to : body->springs.neighbours)
      crossing += std::abs(dot(to.rest, normal));
    mean += crossing;
    ++planes;
  }
  EXPECT_NEAR(mean / planes, body->springs.crossings, 0.002 * body->springs.crossings);
}

TEST(Failures, RateHoldsMoreWhatIsPulledFaster) {
  const auto plan =
      plan_of(block(5, 4, 6,
                    Keys{{"membrane", "I-m"}, {"poisson", 0.1}} +
                        failing("rate", {{"limit", 0.006}, {"reference", 100}, {"exponent", 2}})));
  const Model& model = *plan->model;
  for (const double pull : {0.0, 60.0, 120.0, 700.0}) {  // strain rate, 1/s
    const std::vector<double> u = strained(model, 0.02, 0), v = strained(model, pull, 0);
    std::size_t expected = 0;
    model.body.for_springs([&](Particle a, Particle b, std::uint32_t) {
      const Vec3 rest = model.body.position(b) - model.body.position(a),
                 now = rest + Vec3{0.02 * rest.x, 0, 0};
      const double rate = dot(now, {pull * rest.x, 0, 0}) / norm(now) / norm(rest);
      if (norm(now) / norm(rest) - 1 > 0.006 * (1 + std::sqrt(std::max(rate, 0.0) / 100)))
        ++expected;
    });
    for (const int threads : {1, 2, 5}) {
      Simulation simulation(model, threads);
      simulation.set_displacements(u, std::vector<double>(model.body.particles, 0));
      simulation.set_velocities(v, std::vector<double>(model.body.particles, 0));
      simulation.step(1e-3 * model.step_limit.time_step);
      EXPECT_EQ(simulation.breakages().size(), expected)
          << pull << " per second, " << threads << " threads";
    }
    std::printf("pulled by %g per second: %zu springs break\n", pull, expected);
  }
}

TEST(Failures, RateCountsInListsToo) {
  const ListFiles files(5, 4, 6);
  const Keys law =
      Keys{{"membrane", "none"}} + failing("rate", {{"limit", 0.006}, {"reference", 100}});
  const auto plan = plan_of(listed_scene(files.lattice(), law));
  const Model& model = *plan->model;
  std::set<std::size_t> counts;
  for (const double pull : {-300.0, 0.0, 120.0, 700.0}) {  // strain rate, 1/s
    std::size_t expected = 0;
    for (const ListedSpring& spring : model.body.listed.springs) {
      const Vec3 rest = model.body.position(spring.b) - model.body.position(spring.a),
                 now = rest + Vec3{0.02 * rest.x, 0, 0};
      const double rate = dot(now, {pull * rest.x, 0, 0}) / norm(now) / norm(rest);
      if (norm(now) / norm(rest) - 1 > 0.006 * (1 + std::max(rate, 0.0) / 100)) ++expected;
    }
    counts.insert(expected);
    for (const int threads : {1, 2, 5}) {
      Simulation simulation(model, threads);
      simulation.set_displacements(strained(model, 0.02, 0), {});
      simulation.set_velocities(strained(model, pull, 0), {});
      simulation.step(1e-3 * model.step_limit.time_step);
      EXPECT_EQ(simulation.breakages().size(), expected)
          << pull << " per second, " << threads << " threads";
    }
  }
  EXPECT_GT(counts.size(), 1u);  // the rate makes a difference
}

TEST(Failures, WeibullScattersAsItSays) {
  const auto scattered = [](int seed) {
    return plan_of(block(
        20, 20, 20,
        breakable("weibull", {{"scale", 0.01}, {"modulus", 3}, {"least", 0.2}, {"seed", seed}})));
  };
  const auto plan = scattered(1), other = scattered(2);
  const Model& model = *plan->model;
  std::vector<double> u;
  // The strain is the same in all directions, hence in all springs.
  const auto broken = [&](const Plan& of, double strain) {
    u.clear();
    for (Particle p = 0; p < model.body.particles; ++p) {
      const Vec3 x = model.body.position(p);
      u.insert(u.end(), {strain * x.x, strain * x.y, strain * x.z});
    }
    Simulation simulation(*of.model, 2);
    simulation.set_displacements(u, {});
    simulation.step(1e-3 * model.step_limit.time_step);
    std::set<Spring> found;
    for (const Breakage& breakage : simulation.breakages()) found.insert({breakage.a, breakage.b});
    return found;
  };
  const auto springs = static_cast<double>(model.body.base_springs());
  std::set<Spring> before;
  for (const double strain : {0.003, 0.006, 0.009, 0.012, 0.016}) {
    const double share = 1 - std::exp(-std::pow((strain - 0.002) / 0.008, 3)),
                 scatter = std::sqrt(share * (1 - share) / springs);
    const std::set<Spring> now = broken(*plan, strain);
    EXPECT_NEAR(static_cast<double>(now.size()) / springs, share, 4 * scatter + 1e-12) << strain;
    EXPECT_TRUE(std::includes(now.begin(), now.end(), before.begin(),
                              before.end()));  // a spring keeps its limit
    before = now;
  }
  EXPECT_TRUE(broken(*plan, 0.00199).empty());
  EXPECT_NE(broken(*plan, 0.009), broken(*other, 0.009));
  // The strength of a spring is independent of the strength of the next spring in the numbering.
  const std::set<Spring> some =
      broken(*plan, 0.002 + 0.008 * std::cbrt(std::log(2.0)));  // half of the springs
  double pairs = 0, all = 0;
  for (const Spring& spring : some)
    if (spring.second == spring.first + 1) {
      all += 1;
      pairs += some.count({spring.first + 1, spring.second + 1}) > 0 ? 1 : 0;
    }
  // 18 of 19 springs in a row along x have a next one
  EXPECT_NEAR(pairs / all, 0.5 * 18 / 19, 0.03);
}

/// Compares the elongations of broken springs with the places of their ends in the whole body, step
/// by step, and counts open failures by them.
void follow_broken(const Plan& plan) {
  const Model& model = *plan.model;
  const double step = 0.5 * model.step_limit.time_step;
  for (const int threads : {1, 3}) {
    Simulation simulation(model, threads);
    simulation.set_velocities(noise(3 * model.body.particles, 1.5e-6 / step), {});
    std::set<std::uint64_t> steps;  // with breakages
    std::uint64_t most_open = 0, most_closed = 0;
    for (int n = 0; n < 60; ++n) {
      simulation.step(step);
      std::vector<double> u, heights;
      simulation.displacements(u);
      simulation.heights(heights);
      std::uint64_t open = 0, number = 0;
      for (const Breakage& broken : simulation.breakages()) {
        const auto place = [&](Particle p) {
          return model.body.position(p) + Vec3{u[3 * p], u[3 * p + 1], u[3 * p + 2]};
        };
        const double rise = heights.empty() ? 0 : heights[broken.b] - heights[broken.a],
                     rest = norm(model.body.position(broken.b) - model.body.position(broken.a)),
                     now = std::hypot(norm(place(broken.b) - place(broken.a)), rise);
        const double elongation = simulation.elongation_now(number++);
        EXPECT_NEAR(elongation, now - rest, 1e-15) << threads << " threads, step " << n;
        open += elongation > 0 ? 1 : 0;
        steps.insert(broken.step);
      }
      EXPECT_EQ(simulation.broken_open(), open) << threads << " threads, step " << n;
      most_open = std::max(most_open, open);
      most_closed = std::max(most_closed, number - open);
    }
    EXPECT_GT(steps.size(), 5u);
    EXPECT_GT(most_open, 10u);
    EXPECT_GT(most_closed, 10u);
  }
}

TEST(Failures, OpenOnesAreThoseWhoseEndsAreFartherThanAtRest) {
  const Keys failure = failing("elongation", {{"limit", 2e-6}});
  follow_broken(*plan_of(block(7, 6, 8, Keys{{"membrane", "I-m"}, {"poisson", 0.2}} + failure)));
  const ListFiles files(5, 4, 6);
  follow_broken(*plan_of(listed_scene(files.lattice(), Keys{{"membrane", "none"}} + failure)));
}

}  // namespace failures_test
