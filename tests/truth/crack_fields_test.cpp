// The fields crack_opening and crack_time: the bar whose opening is known, halves that are far
// apart and turned, restarts and threads. See docs/theory/cohesive.md.
#include <run/snapshot.hpp>
#include <support/archives.hpp>
#include <support/cohesive_bar.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace crack_fields_test {
using namespace hyperlattice;
using namespace hyperlattice::test;
using namespace hyperlattice::test::cohesive_bar;

std::vector<double> openings(const Simulation& simulation) {
  std::vector<double> values;
  simulation.crack_openings(values);
  return values;
}
std::vector<double> times(const Simulation& simulation) {
  std::vector<double> values;
  simulation.crack_times(values);
  return values;
}

/// Sums over the rows of particles of a bar.
std::vector<double> rows_of(const Bar& bar, const std::vector<double>& values) {
  std::vector<double> sums;
  const auto count = static_cast<std::ptrdiff_t>(2 * bar.half + 1);
  for (auto row = values.begin(); row != values.end(); row += count)
    sums.push_back(std::accumulate(row, row + count, 0.0));
  return sums;
}

/// The worst errors, over the opening, of the sums over a bar's rows while it is pulled.
struct RowErrors {
  double softening = 0, separated = 0;
  int stages = 0;
};
/// Pulls a bar until its opening, its growth less that of an elastic bar under the same stress, is
/// three times that at which the traction ends.
RowErrors pull(const Bar& bar) {
  const Model& model = *bar.plan->model;
  const double last = 2 * model.cohesive[0].corrected / strength,
               elastic = mm(2 * bar.half) / model.cohesive[0].modulus,
               step = 0.85 * model.step_limit.time_step;
  RowErrors found;
  for (double w = 0; w < 3 * last;) {
    for (int n = 0; n < 100; ++n) bar.simulation->step(step);
    w = bar.growth() - elastic * bar.stress();
    if (w < 0.1 * last) continue;
    double& worst = w < last ? found.softening : found.separated;
    for (const double sum : rows_of(bar, openings(*bar.simulation)))
      worst = std::max(worst, std::abs(sum / w - 1));
    ++found.stages;
  }
  std::printf("%d stages, softening %.4f, separated %.4f\n", found.stages, found.softening,
              found.separated);
  return found;
}

/// Moves the particles of a bar beyond its most damaged one by `apart`, m, along it, and these half
/// as far.
void separate(const Bar& bar, double apart) {
  const std::vector<double> damage = damage_of(*bar.plan->model, *bar.simulation);
  const auto count = static_cast<std::ptrdiff_t>(2 * bar.half + 1);
  const auto middle = std::max_element(damage.begin(), damage.begin() + count) - damage.begin();
  std::vector<double> u = displacements(*bar.simulation);
  for (std::size_t p = 0; p < damage.size(); ++p) {
    const auto place = static_cast<std::ptrdiff_t>(p) % count;
    u[3 * p] += place > middle ? apart : place == middle ? apart / 2 : 0;
  }
  bar.simulation->set_displacements(u, {});
}

/// Turns the body by 2 radians about (1, 2, 2) / 3.
void turn(const Model& model, Simulation& simulation) {
  std::vector<double> u = displacements(simulation);
  const Vec3 axis{1 / 3.0, 2 / 3.0, 2 / 3.0};
  for (Particle p = 0; p < model.body.particles; ++p) {
    const Vec3 at = model.body.position(p), x = at + Vec3{u[3 * p], u[3 * p + 1], u[3 * p + 2]},
               moved = std::cos(2.0) * x + std::sin(2.0) * cross(axis, x) +
                       (1 - std::cos(2.0)) * dot(axis, x) * axis - at;
    for (std::size_t c = 0; c < 3; ++c) u[3 * p + c] = moved[c];
  }
  simulation.set_displacements(u, {});
}

// From the first opening to far beyond the end of the traction. Then the halves are put far apart,
// and the whole is turned. The strains of 0.001 make the elastic part differ by as much.
TEST(CrackOpening, OfARowOfABarIsItsGrowthLessTheElasticPart) {
  const Bar bar(8, 0.25, 3e-3, "double", 1, true);
  const RowErrors found = pull(bar);
  EXPECT_GT(found.stages, 20);
  EXPECT_LT(found.softening, 0.03);
  EXPECT_LT(found.separated, 0.005);
  const double apart = 5 * spacing, before = bar.growth();
  separate(bar, apart);
  const std::vector<double> far = openings(*bar.simulation);
  for (const double sum : rows_of(bar, far)) EXPECT_NEAR(sum, before + apart, 1e-3 * apart);
  turn(*bar.plan->model, *bar.simulation);
  const std::vector<double> turned = openings(*bar.simulation);
  for (std::size_t p = 0; p < far.size(); ++p) EXPECT_NEAR(turned[p], far[p], 1e-6 * spacing) << p;
}

// The membrane's cross springs soften in both signs, and carry a part of the stress.
TEST(CrackOpening, OfARowOfABarWithAMembraneToo) {
  const RowErrors found = pull(Bar(8, 0.2, 3e-3, "double", 1, true));
  EXPECT_LT(found.softening, 0.03);
  EXPECT_LT(found.separated, 0.005);
}

// The time is that of the step in which an observer sees the damage pass its bound.
TEST(CrackTime, IsThatOfTheStepInWhichDamagePassesItsBound) {
  const auto plan = torn_bar(0.25);
  const Model& model = *plan->model;
  const double step = 0.4 * model.step_limit.time_step;
  Simulation one(model, 1), three(model, 3), first(model, 2), second(model, 2);
  for (Simulation* simulation : {&one, &three, &first}) set_tearing(model, *simulation);
  std::vector<double> seen(model.body.particles, NAN);
  int cracked = 0;
  for (int n = 0; n < 300; ++n) {
    const double now = one.time();
    one.step(step);
    three.step(step);
    first.step(step);
    if (n == 150) {
      const std::vector<char> bytes = saved(first);
      EXPECT_EQ(restore(second, bytes), bytes.size());
    }
    if (n > 150) second.step(step);
    const std::vector<double> damage = damage_of(model, one);
    for (Particle p = 0; p < seen.size(); ++p) {
      if (damage[p] < 0.9 || !std::isnan(seen[p])) continue;
      seen[p] = now;
      ++cracked;
    }
    if (n == 150) {
      EXPECT_GT(cracked, 10);  // the restart has some to keep
    }
  }
  EXPECT_GT(cracked, 30);
  const std::vector<double> opening = openings(one);
  for (const Simulation* simulation : {&one, &three, &second}) {
    const std::vector<double> found = times(*simulation);
    ASSERT_EQ(found.size(), seen.size());
    for (Particle p = 0; p < seen.size(); ++p) {
      EXPECT_EQ(std::isnan(found[p]), std::isnan(seen[p])) << p;
      if (!std::isnan(seen[p])) {
        EXPECT_EQ(found[p], seen[p]) << p;
      }
    }
    EXPECT_EQ(openings(*simulation), opening);
  }
}

TEST(CrackFields, AreThoseOfTheSnapshotAndNeedAFieldOfDamage) {
  const auto plan = torn_bar(0.25);
  Simulation simulation(*plan->model, 1);
  set_tearing(*plan->model, simulation);
  for (int n = 0; n < 300; ++n) simulation.step(0.4 * plan->model->step_limit.time_step);
  SnapshotSource source(*plan->model, simulation);
  const Snapshot& snapshot = source.take();
  Field opening, time, damage;
  ASSERT_TRUE(snapshot.field("crack_opening", opening));
  ASSERT_TRUE(snapshot.field("crack_time", time));
  ASSERT_TRUE(snapshot.field("damage", damage));
  const std::vector<double> expected = openings(simulation);
  for (std::size_t n = 0; n < expected.size(); ++n) {
    EXPECT_EQ(opening.values[n], expected[n]);
    if (damage.values[n] == 0) {
      EXPECT_EQ(opening.values[n], 0);
    }
    EXPECT_EQ(std::isnan(time.values[n]), damage.values[n] < 0.9) << n;
  }
  const std::string scene =
      SceneBuilder{}
          .lattice("lattices.cubic", spacing, box_mm(2, 2, 2))
          .material("materials.elastic", {{"young", young}, {"density", 2500}, {"poisson", 0.25}})
          .solver("solvers.explicit", {{"end_time", 1e-6}})
          .stage("writers.vtu", {{"fields", {"crack_time"}}})
          .text();
  try {
    plan_of(scene);
    FAIL() << "a field that the run does not have";
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("crack_time"), std::string::npos) << error.what();
  }
}

}  // namespace crack_fields_test
