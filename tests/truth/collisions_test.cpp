// Bodies that collide. A moving bar hits an equal bar at rest. After the waves of the impact have
// run to the ends and back, the second bar moves and the first is at rest (Saint-Venant 1867).
// Momentum and energy are kept, and results do not depend on the number of threads.
#include <state/simulation.hpp>

#include <support/scenes.hpp>

#include <gtest/gtest.h>

namespace collisions_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

/// Two bars of 30 x 3 x 3 cells, 2 mm between their last particles; the left bar moves at 10 m/s.
std::unique_ptr<Plan> bars(const Stages& contact, int threads = 1) {
  const Json both = {
      {"union",
       {box({}, {0.0299, 0.0029, 0.0029}), box({0.0311, 0, 0}, {0.0609, 0.0029, 0.0029})}}};
  return plan_of(
      SceneBuilder{}
          .region("left", box({-1, -1, -1}, {0.0305, 1, 1}))
          .lattice("lattices.cubic", 1e-3, both, {{"anchor", {0, 0, 0}}})
          .material("materials.elastic", {{"young", 1e10}, {"density", 2500}, {"membrane", "none"}})
          .load("loads.start_velocity", {{"on", "left"}, {"linear", {10, 0, 0}}})
          .stages(contact)
          .solver("solvers.explicit", {{"end_time", 3e-4}})
          .text(),
      threads);
}
Stages contacts(const Keys& keys = {}) { return stage("loads.contact", keys); }

struct Met {
  double left = 0, right = 0;  ///< mean velocities along x, m/s
  double largest_error = 0;    ///< relative error of the energy balance
  EnergyBalance start, end;
  std::uint64_t hash = 0;
};
Met meet(const Plan& plan) {
  Simulation simulation(*plan.model, plan.threads);
  Met met;
  met.start = simulation.balance();
  const double step = 0.5 * plan.model->step_limit.time_step;
  while (simulation.time() < 3e-4) {
    simulation.step(step);
    met.end = simulation.balance();
    met.largest_error = std::max(met.largest_error, std::abs(met.end.relative_error()));
  }
  std::vector<double> v;
  simulation.velocities(v);
  const std::uint64_t half = plan.model->body.particles / 2;
  EXPECT_EQ(half, 270u);
  for (Particle p = 0; p < plan.model->body.particles; ++p)
    (plan.model->body.position(p).x < 0.0305 ? met.left : met.right) +=
        v[3 * p] / static_cast<double>(half);
  met.hash = simulation.hash();
  return met;
}

TEST(Collisions, EqualBarsExchangeTheirVelocities) {
  const Met met = meet(*bars(contacts()));
  std::printf("after the impact: %.4f and %.4f m/s of 10; balance error %.1e\n", met.left,
              met.right, met.largest_error);
  EXPECT_NEAR(met.left, 0, 0.2);  // waves across the bars keep a small part
  EXPECT_NEAR(met.right, 10, 0.2);
  EXPECT_NEAR(met.end.momentum.x / met.start.momentum.x, 1, 1e-12);
  EXPECT_LT(met.largest_error, 1e-3);
  EXPECT_NEAR((met.end.kinetic + met.end.stored) / met.start.kinetic, 1,
              1e-3);  // no energy is left in contacts
}

TEST(Collisions, WithoutItBodiesGoThroughEachOther) {
  const Met met = meet(*bars({}));
  EXPECT_NEAR(met.left, 10, 1e-9);
  EXPECT_NEAR(met.right, 0, 1e-9);
}

TEST(Collisions, DampingTakesEnergyAndNoMomentum) {
  const Met met = meet(*bars(contacts({{"damping", 0.5}, {"friction", 0.3}})));
  EXPECT_NEAR(met.end.momentum.x / met.start.momentum.x, 1, 1e-12);
  EXPECT_LT(met.end.kinetic + met.end.stored, 0.999 * met.start.kinetic);
  EXPECT_GT(met.right, met.left);
}

// The critical time step accounts for contacts of any stiffness and any damping.
TEST(Collisions, StiffContactsStayStable) {
  for (const Keys& more : {Keys{}, Keys{{"damping", 1}, {"friction", 1}, {"grip", 2}}}) {
    // 30 times the stiffness of a spring
    const Met met = meet(*bars(contacts(Keys{{"stiffness", 1e8}} + more)));
    std::printf("after the impact: %.4f and %.4f m/s of 10; balance error %.1e\n", met.left,
                met.right, met.largest_error);
    EXPECT_NEAR(met.end.momentum.x / met.start.momentum.x, 1, 1e-11);
    EXPECT_LT(met.end.kinetic + met.end.stored, 1.001 * met.start.kinetic);
    EXPECT_LT(met.largest_error, 0.02);
    EXPECT_GT(met.right, 9);
  }
}

// The stiffest springs of the bars are more than 1e4 times as stiff as these contacts.
TEST(Collisions, TooSoftContactsAreWarnedOf) {
  const auto warned = [](const Stages& contact) {
    const auto plan = bars(contact);
    return std::any_of(plan->model->warnings.begin(), plan->model->warnings.end(),
                       [](const std::string& text) {
                         return text.find("particles may pass through") != std::string::npos;
                       });
  };
  EXPECT_TRUE(warned(contacts({{"stiffness", 1}})));
  EXPECT_TRUE(warned(stage("loads.floor", {{"stiffness", 1}, {"point", {0, 0, -1}}})));
  EXPECT_FALSE(warned(contacts() + stage("loads.floor", {{"point", {0, 0, -1}}})));
}

TEST(Collisions, ResultsDoNotDependOnThreads) {
  const Stages contact = contacts({{"damping", 0.1}, {"friction", 0.3}});
  EXPECT_EQ(meet(*bars(contact, 1)).hash, meet(*bars(contact, 3)).hash);
}

}  // namespace collisions_test
