// Loads that answer to the motion: their momentum and energy against closed forms, and their effect
// on the critical time step.
#include <support/energy_balance.hpp>
#include <support/loaded_block.hpp>
#include <support/scenes.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace answering_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

const Keys membrane = {{"membrane", "I-m"}, {"poisson", 0.1}};

struct Case {
  const char* name;
  Stages loads;
};
const Case inner[] = {
    {"force",
     stage("loads.actuation",
           {{"on", "half"}, {"force", 20}, {"form", "triangle"}, {"rise", 1e-6}, {"fall", 1e-6}})},
    {"strain",
     stage("loads.actuation",
           {{"on", "half"}, {"strain", -0.02}, {"form", "half_sine"}, {"duration", 2e-6}})},
    {"expression",
     stage("loads.expression",
           {{"on", "half"}, {"force", 20}, {"expression", "1 * sin(2 * pi * 4e5 * t) + 0"}})},
};
const Case outer[] = {
    {"pressure", stage("loads.actuation", {{"on", "z_max"}, {"pressure", 1e8}, {"rise", 1e-6}})},
    {"drag",
     stage(
         "loads.drag",
         {{"density", 1000}, {"stream", {30, 0, 10}}, {"top_speed", 100}, {"linear_along", 1e5}})},
    {"floor", stage("loads.floor", {{"friction", 0.5}, {"point", {0, 0, 0.0001}}}) +
                  stage("loads.start_velocity", {{"linear", {5, 0, -10}}})},
    {"slow_floor",
     stage("loads.floor",
           {{"friction", 0.5}, {"friction_back", 0.1}, {"forward", {1, 1, 0}}, {"damping", 0}}) +
         stage("loads.gravity", {{"acceleration", {1e6, 0, -4e6}}})},
};

class Inner : public testing::TestWithParam<Case> {};
class Answering : public testing::TestWithParam<Case> {};
const auto name_of = [](const auto& info) { return std::string(info.param.name); };
INSTANTIATE_TEST_SUITE_P(Inner, Inner, testing::ValuesIn(inner), name_of);
INSTANTIATE_TEST_SUITE_P(Inner, Answering, testing::ValuesIn(inner), name_of);
INSTANTIATE_TEST_SUITE_P(Outer, Answering, testing::ValuesIn(outer), name_of);

TEST_P(Inner, KeepsMomentumAndSpin) {
  for (const char* boundary : {"particles", "cells"}) {
    const auto plan =
        plan_of(loaded_block(5, 4, 8, GetParam().loads, 1e10, membrane, {{"boundary", boundary}}));
    const Model& model = *plan->model;
    Simulation simulation(model, 2);
    for (int n = 0; n < 300; ++n) simulation.step(0.5 * model.step_limit.time_step);
    const Sums now = sums(model, simulation);
    EXPECT_GT(now.size, 0);
    EXPECT_LT(norm(now.momentum), 1e-13 * now.size) << boundary;
    EXPECT_LT(norm(now.spin), 1e-13 * now.size * 8e-3) << boundary;
  }
}

TEST_P(Answering, TheBalanceClosesToTheSquareOfTheStep) {
  for (const Keys& material : {Keys{{"poisson", 0.25}}, membrane}) {
    const auto plan = plan_of(loaded_block(5, 4, 6, GetParam().loads, 1e10, material));
    const WorstBalance at_two_fifths = worst_balance(*plan->model, 0.4),
                       at_a_fifth = worst_balance(*plan->model, 0.2);
    for (const WorstBalance* balance : {&at_two_fifths, &at_a_fifth})
      EXPECT_NE(balance->last.injected, 0);
    const double coarse = at_two_fifths.largest_error, fine = at_a_fifth.largest_error;
    std::printf(
        "%s: largest relative error %.2e at 0.4 of the critical step, %.2e at 0.2: ratio %.2f\n",
        GetParam().name, coarse, fine, coarse / fine);
    EXPECT_LT(coarse, 5e-3);
    EXPECT_GT(coarse / fine, 3) << "half the step, a quarter of the error";
  }
}

TEST_P(Answering, TheSameBitsForAnyNumberOfThreads) {
  const auto plan = plan_of(loaded_block(5, 4, 9, GetParam().loads, 1e10, membrane));
  std::vector<std::uint64_t> hashes;
  std::vector<double> works;
  for (const int threads : {1, 2, 3, 7}) {
    Simulation simulation(*plan->model, threads);
    for (int n = 0; n < 60; ++n) simulation.step(0.5 * plan->model->step_limit.time_step);
    hashes.push_back(simulation.hash());
    works.push_back(simulation.balance().injected);
  }
  for (std::size_t n = 1; n < hashes.size(); ++n) {
    EXPECT_EQ(hashes[n], hashes[0]);
    EXPECT_EQ(works[n], works[0]);
  }
}

// The block is soft and gravity is strong, so that the block slides far in few steps.
constexpr double heavy = 500;  // m/s2
std::string sliding(const Keys& floor, Vec3 gravity, Vec3 start) {
  return loaded_block(5, 5, 3,
                      stage("loads.floor", floor) +
                          stage("loads.gravity", {{"acceleration", gravity}}) +
                          stage("loads.start_velocity", {{"linear", start}}),
                      1e7);
}
/// The mean position and velocity of the body at that time.
std::pair<Vec3, Vec3> mean_motion(const Plan& plan, double time) {
  const Model& model = *plan.model;
  Simulation simulation(model, 2);
  while (simulation.time() < time) simulation.step(0.5 * model.step_limit.time_step);
  std::vector<double> u, v;
  simulation.displacements(u);
  simulation.velocities(v);
  Vec3 place, speed;
  const double share = 1 / static_cast<double>(model.body.particles);
  for (Particle p = 0; p < model.body.particles; ++p) {
    place = place + share * Vec3{u[3 * p], u[3 * p + 1], u[3 * p + 2]};
    speed = speed + share * Vec3{v[3 * p], v[3 * p + 1], v[3 * p + 2]};
  }
  return {place, speed};
}

TEST(Floor, CarriesTheWeightAndStopsASlidingBlock) {
  const auto plan = plan_of(sliding({{"friction", 0.4}}, {0, 0, -heavy}, {2, 0, 0}));
  const auto [place, speed] = mean_motion(*plan, 20e-3);  // the block stops after 10 ms
  EXPECT_NEAR(place.x, 4 / (2 * 0.4 * heavy), 0.03 * place.x);
  EXPECT_LT(std::abs(speed.x), 0.01);
  // The floor yields by m g / c under each particle, and the body by its own weight.
  EXPECT_NEAR(place.z, 0, 0.3e-3);
}

TEST(Floor, HasAnotherFrictionBackwards) {
  const Keys floor = {{"friction", 0.2}, {"friction_back", 0.6}, {"forward", {1, 0, 0}}};
  const double forward =
      mean_motion(*plan_of(sliding(floor, {0, 0, -heavy}, {1, 0, 0})), 15e-3).first.x;
  const double back =
      -mean_motion(*plan_of(sliding(floor, {0, 0, -heavy}, {-1, 0, 0})), 15e-3).first.x;
  EXPECT_NEAR(forward, 1 / (2 * 0.2 * heavy), 0.04 * forward);
  EXPECT_NEAR(back, 1 / (2 * 0.6 * heavy), 0.06 * back);
}

TEST(Floor, AnInclineHoldsABlockUpToItsFriction) {
  for (const double slope : {0.2, 0.4}) {  // tangent of the slope; the friction is 0.3
    const double down = heavy / std::hypot(1, slope);
    const auto [place, speed] =
        mean_motion(*plan_of(sliding({{"friction", 0.3}}, {slope * down, 0, -down}, {})), 10e-3);
    if (slope < 0.3)
      EXPECT_LT(speed.x, 0.01);
    else
      EXPECT_NEAR(speed.x, (slope - 0.3) * down * 10e-3, 0.03 * speed.x);
  }
}

TEST(Drag, LinearSlowsExponentiallyAndQuadraticHyperbolically) {
  // A cube of edge h moves along x. Its front and back have the drag across, two of its sides the
  // drag along.
  const double h = 4e-3, mass = 2500 * h * h * h;
  const auto drag = [](const Keys& across, const Keys& along, double speed) {
    Stages loads = stage("loads.start_velocity", {{"linear", Vec3{speed, 0, 0}}});
    for (const char* face : {"x_min", "x_max", "y_min", "y_max"})
      loads = loads + stage("loads.drag", Keys{{"on", face}} + (face[0] == 'x' ? across : along));
    return plan_of(loaded_block(4, 4, 4, loads));
  };
  const double linear = (2 * 3e3 + 2 * 1e3) * h * h / mass;
  const auto first = drag({{"linear_across", 3e3}}, {{"linear_along", 1e3}}, 1);
  EXPECT_NEAR(mean_motion(*first, 1e-3).second.x, std::exp(-linear * 1e-3), 0.01);
  const double quadratic = 0.5 * 1000 * (2 * 1.5 + 2 * 0.5) * h * h / mass;
  const auto second = drag({{"density", 1000}, {"across", 1.5}, {"top_speed", 20}},
                           {{"density", 1000}, {"along", 0.5}, {"top_speed", 20}}, 10);
  EXPECT_NEAR(mean_motion(*second, 1e-3).second.x, 10 / (1 + 10 * quadratic * 1e-3), 0.05);
}

/// Does the body stay bounded over 3000 steps of this fraction of the critical time step?
bool is_bounded(const Model& model, double fraction) {
  Simulation simulation(model, 1);
  simulation.set_velocities(noise(3 * model.body.particles, 1e-6, 7), {});
  for (int n = 0; n < 3000; ++n) simulation.step(fraction * model.step_limit.time_step);
  return largest(displacements(simulation)) < 1e-3;
}

TEST(CriticalStep, KnowsHowStiffAContactIsAndHowViscous) {
  const auto free =
      plan_of(loaded_block(4, 4, 4, stage("loads.gravity", {{"acceleration", {0, 0, 0}}})));
  const double mass = 2500e-9, alone = free->model->step_limit.time_step;
  // The contact is far stiffer than the body, so that a particle oscillates on its contact alone.
  // The floor stands above the lowest particles, so that all of z_min always touches it.
  const auto stiff = plan_of(loaded_block(
      4, 4, 4,
      stage("loads.floor",
            {{"on", "z_min"}, {"stiffness", 1e9}, {"damping", 0}, {"point", {0, 0, 1e-5}}})));
  EXPECT_NEAR(stiff->model->step_limit.time_step, 2 / std::sqrt(4 / (alone * alone) + 1e9 / mass),
              1e-12 * alone);
  EXPECT_NE(stiff->model->step_limit.because.find("loads.floor (/pipeline/2)"), std::string::npos);
  const auto viscous = plan_of(
      loaded_block(4, 4, 4, stage("loads.drag", {{"linear_across", 1e9}, {"linear_along", 1e9}})));
  const double rate = 1e9 * std::sqrt(3.0) * 1e-6 / mass;  // rate of a corner particle
  EXPECT_NEAR(viscous->model->step_limit.time_step,
              2 / (rate / 2 + std::sqrt(rate * rate / 4 + 4 / (alone * alone))), 1e-9 * alone);
  EXPECT_TRUE(is_bounded(*viscous->model, 0.99));
  EXPECT_FALSE(is_bounded(*viscous->model, 1.1));
}

TEST(AnsweringLoads, StaticSolversRefuseSuchLoads) {
  std::string text = loaded_block(3, 3, 3, stage("loads.floor"));
  text.replace(text.find("solvers.explicit"), 16, "solvers.static");
  try {
    plan_of(text);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("do not answer to the motion"), std::string::npos)
        << error.what();
  }
}

}  // namespace answering_test
