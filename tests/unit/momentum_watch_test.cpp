// The momentum of a free body is the impulse of its loads; what they do not explain is found.
#include <engine/momentum_watch.hpp>
#include <support/archives.hpp>
#include <support/scenes.hpp>

#include <gtest/gtest.h>

namespace momentum_watch_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

const Stages push = stage("loads.force", {{"on", "z_max"}, {"total", {1, 0.5, 2}}, {"rise", 2e-6}});
const Stages weight = stage("loads.gravity", {{"acceleration", {0, 0, -9.81}}});
const Stages clamp = stage("loads.fixed", {{"on", "z_min"}, {"axes", "x"}});

/// A block under loads, and the watch of its momentum.
struct Watched {
  explicit Watched(const Stages& loads, const std::string& precision = "double")
      : plan(plan_of(SceneBuilder(block(4, 4, 6, {{"poisson", 0.25}}, loads))
                         .key("precision", precision)
                         .text())) {}
  /// Goes on by 20 steps, and takes a record of a momentum that is `more` too large.
  double error_after_steps(Vec3 more = {}) {
    for (int n = 0; n < 20; ++n) simulation.step(0.9 * plan->model->step_limit.time_step);
    EnergyBalance balance = simulation.balance();
    balance.momentum += more;
    return watch.error_of(balance, simulation.time());
  }
  std::unique_ptr<Plan> plan;
  Simulation simulation{*plan->model, 1};
  MomentumWatch watch{*plan->model};
};
const Vec3 unexplained{0, 1e-5, 0};  // N s; the block's momentum is about 1e-5 N s

TEST(MomentumWatch, KnowsTheImpulseOfLoads) {
  Watched body(push + weight);
  for (int record = 0; record < 10; ++record) EXPECT_LT(body.error_after_steps(), 1e-10);
  EXPECT_GT(body.error_after_steps(unexplained), 1e-3);
}

TEST(MomentumWatch, BeginsAnewWhereMotionIsSetOrStopped) {
  Watched body(push);
  for (int record = 0; record < 3; ++record) EXPECT_LT(body.error_after_steps(), 1e-10);
  std::vector<double> velocity;
  body.simulation.velocities(velocity);
  for (double& number : velocity) number *= -1;
  body.simulation.set_velocities(velocity, {});  // with the same energy
  for (int record = 0; record < 3; ++record) EXPECT_LT(body.error_after_steps(), 1e-10);
  body.simulation.halt();
  for (int record = 0; record < 3; ++record) EXPECT_LT(body.error_after_steps(), 1e-10);
  EXPECT_GT(body.error_after_steps(unexplained), 1e-3);
}

TEST(MomentumWatch, BeginsAnewWhereSolversDamp) {
  Watched body(push);
  for (int record = 0; record < 3; ++record) EXPECT_LT(body.error_after_steps(), 1e-10);
  body.simulation.set_damping(0, 1e5);
  for (int n = 0; n < 5; ++n) body.simulation.step(body.plan->model->step_limit.time_step / 2);
  body.simulation.set_damping(0);
  for (int record = 0; record < 3; ++record) EXPECT_LT(body.error_after_steps(), 1e-10);
}

TEST(MomentumWatch, GoesOnAfterARestart) {
  Watched body(push + weight), other(push + weight);
  for (int record = 0; record < 3; ++record) body.error_after_steps();
  restore(other.simulation, saved(body.simulation));
  restore(other.watch, saved(body.watch));
  const double error = body.error_after_steps(unexplained);
  EXPECT_GT(error, 1e-3);
  EXPECT_EQ(other.error_after_steps(unexplained), error);
}

TEST(MomentumWatch, IsSilentWhereLoadsHoldOrNumbersAreShort) {
  Watched held(push + clamp), short_numbers(push, "float");
  for (Watched* body : {&held, &short_numbers})
    for (int record = 0; record < 3; ++record) EXPECT_EQ(body->error_after_steps(unexplained), 0);
}

}  // namespace momentum_watch_test
