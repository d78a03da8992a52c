// The fields crack_opening and crack_time: the bar whose opening is known, halves that fly apart
// and turn, an oblique crack, restarts and threads. See docs/theory/cohesive.md.
#include <run/snapshot.hpp>
#include <support/archives.hpp>
#include <support/cohesive_bar.hpp>

#include <gtest/gtest.h>

#include <cmath>
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

// The rows of a bar add up to what it is longer than an elastic one of the same stress, from the
// first opening to far beyond the end of the traction.
TEST(CrackOpening, OfARowOfABarIsItsLengthLessTheElasticPart) {
  for (const double poisson : {0.25, 0.2}) {
    const double length = 3e-3;
    Bar bar(8, poisson, length, "double");
    const Model& model = *bar.plan->model;
    const double last = 2 * model.cohesive[0].corrected / strength,
                 step = 0.85 * model.step_limit.time_step;
    double compliance = 0, worst = 0, worst_late = 0, largest_opening = 0;
    int stages = 0;
    const auto count = static_cast<std::ptrdiff_t>(2 * bar.half + 1);
    for (int n = 0; largest_opening < 3 * last; ++n) {
      ASSERT_LT(bar.simulation->time(), 2 * Bar::time(mm(2 * bar.half)));
      bar.simulation->step(step);
      if (n % 100 != 0) continue;
      const double stress = bar.stress(), growth = bar.growth();
      if (stress > 0.4 * strength && stress < 0.8 * strength && stages == 0)
        compliance = growth / stress;
      const std::vector<double> opening = openings(*bar.simulation);
      const double expected = growth - compliance * stress;
      if (compliance == 0 || expected < 0.1 * last) {
        continue;
      }
      ++stages;
      // each of the four rows of the bar
      for (std::ptrdiff_t row = 0; row < 4; ++row) {
        const auto from = opening.begin() + row * count;
        const double sum = std::accumulate(from, from + count, 0.0);
        (expected < last ? worst : worst_late) =
            std::max(expected < last ? worst : worst_late, std::abs(sum / expected - 1));
        largest_opening = std::max(largest_opening, sum);
      }
    }
    std::printf("nu %.2f: %d stages, worst %.4f, beyond w_c %.4f, w %.1f w_c, %.3f spacings\n",
                poisson, stages, worst, worst_late, largest_opening / last,
                largest_opening / spacing);
    EXPECT_GT(stages, 20);
    EXPECT_LT(worst, 0.03);
    EXPECT_LT(worst_late, 0.01);
  }
}

// Far apart, the openings of a row are the distances between its pieces. Turning and moving the
// body changes nothing.
TEST(CrackOpening, OfPiecesFarApartIsTheirDistance) {
  const auto plan = torn_bar(0.25);
  const Model& model = *plan->model;
  Simulation simulation(model, 2);
  set_tearing(model, simulation);
  const double step = 0.4 * model.step_limit.time_step;
  for (int n = 0; n < 3000; ++n) simulation.step(step);
  const std::vector<double> opening = openings(simulation), u = displacements(simulation);
  std::vector<double> expected(16, 0), sum(16, 0);
  for (Particle p = 0; p < model.body.particles; ++p) {
    const Vec3 at = model.body.position(p);
    sum[p % 16] += opening[p];
    if (at.z == model.body.highest.z) expected[p % 16] += u[3 * p + 2];
    if (at.z == model.body.lowest.z) expected[p % 16] -= u[3 * p + 2];
  }
  for (std::size_t row = 0; row < 16; ++row) {
    std::printf("%zu: %.4f %.4f\n", row, sum[row] / spacing, expected[row] / spacing);
    EXPECT_NEAR(sum[row], expected[row], 0.02 * expected[row]) << row;
  }
  // a turn by 2 radians about (1, 2, 2) / 3
  const Vec3 axis{1 / 3.0, 2 / 3.0, 2 / 3.0};
  std::vector<double> turned(u.size());
  for (Particle p = 0; p < model.body.particles; ++p) {
    const Vec3 at = model.body.position(p), x = at + Vec3{u[3 * p], u[3 * p + 1], u[3 * p + 2]},
               y = std::cos(2.0) * x + std::sin(2.0) * cross(axis, x) +
                   (1 - std::cos(2.0)) * dot(axis, x) * axis - at;
    for (std::size_t c = 0; c < 3; ++c) turned[3 * p + c] = y[c];
  }
  simulation.set_displacements(turned, {});
  const std::vector<double> same = openings(simulation);
  for (Particle p = 0; p < model.body.particles; ++p)
    EXPECT_NEAR(same[p], opening[p], 1e-9 * spacing) << p;
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
    EXPECT_EQ(opening.values[n] > 0, damage.values[n] > 0 && opening.values[n] > 0);
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
