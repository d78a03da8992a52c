// A time step uses the mean of a load factor over the step. Impulses are therefore exact for any
// function of time and any step, the energy balance closes as with smooth loads, and stages with
// different steps lose nothing.
#include <base/errors.hpp>
#include <engine/stage_calls.hpp>
#include <support/scenes.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace impulse_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

/// The state after all stages of a scene, which run one after the other.
struct Result {
  EnergyBalance last;
  double largest_error = 0, time = 0;
  std::uint64_t steps = 0;
};
Result run_stages(const Plan& plan, std::uint64_t look_every = 20) {
  Simulation simulation(*plan.model, 1);
  Result result;
  simulation.balance();
  for (const PlannedStage& stage : plan.stages) {
    StageCalls::Hooks hooks;
    hooks.observe = [&] {
      if (simulation.steps() % look_every == 0)
        result.largest_error =
            std::max(result.largest_error, std::abs(simulation.balance().relative_error()));
    };
    StageCalls(*plan.model, simulation, stage, 1, std::move(hooks)).run();
  }
  result.last = simulation.balance();
  result.time = simulation.time();
  result.steps = simulation.steps();
  return result;
}

/// A free or held block of 1 mm cells with loads and solver stages.
std::string scene(const Stages& loads, const Stages& solvers, int nx = 4, int ny = 4, int nz = 5,
                  const Keys& material = {{"poisson", 0.25}}) {
  return SceneBuilder{}
      .lattice("lattices.cubic", 1e-3, box_mm(nx, ny, nz))
      .material("materials.elastic", Keys{{"young", 1e10}, {"density", 2500}} + material)
      .stages(loads)
      .stages(solvers)
      .text();
}
Stages explicit_to(double end) { return stage("solvers.explicit", {{"end_time", end}}); }
Stages explicit_to(double end, double step) {
  return stage("solvers.explicit", {{"end_time", end}, {"time_step", step}});
}
Stages fixed(const char* on) { return stage("loads.fixed", {{"on", on}}); }
Stages force(const char* on, const Json& total, const Keys& more = {}) {
  return stage("loads.force", Keys{{"on", on}, {"total", total}} + more);
}
Stages pressed(double pressure, const Keys& time_function) {
  return stage("loads.actuation", Keys{{"on", "z_min"}, {"pressure", pressure}} + time_function);
}

struct Pulse {
  const char* name;
  const char* time_function;  ///< keys of loads.actuation
  double integral;            ///< integral from 0 to 10 us, s
};
const Pulse pulses[] = {
    {"a_jump_down", R"("form": "constant", "duration": 5e-6)", 5e-6},
    {"a_jump_up", R"("form": "constant", "start": 3.3e-6)", 6.7e-6},
    {"a_ramp", R"("form": "constant", "start": 1.05e-6, "rise": 2.13e-6)", 8.95e-6 - 1.065e-6},
    {"shorter_than_a_step", R"("form": "constant", "start": 3.37e-6, "duration": 1e-9)", 1e-9},
    {"at_the_start_shorter_than_a_step", R"("form": "constant", "duration": 1e-9)", 1e-9},
    {"half_a_sine", R"("form": "half_sine", "start": 1e-6, "duration": 3e-6)",
     3e-6 * 2 / std::numbers::pi},
    {"half_a_sine_shorter_than_a_step", R"("form": "half_sine", "start": 1e-6, "duration": 1e-8)",
     1e-8 * 2 / std::numbers::pi},
    {"half_a_sine_of_three_steps", R"("form": "half_sine", "start": 1.1e-6, "duration": 3.1e-7)",
     3.1e-7 * 2 / std::numbers::pi},
    {"a_table_with_jumps",
     R"("form": "table", "start": 0.21e-6, "times": [0.5e-6, 1.2e-6, 3e-6], "values": [1, -2, 3])",
     -0.5 * 0.7e-6 + 0.5 * 1.8e-6},
    {"a_train",
     R"("form": "triangle", "rise": 0.3e-6, "fall": 0.7e-6, "period": 1.1e-6, "pulses": 8)", 4e-6},
    {"a_train_within_steps",
     R"("form": "triangle", "rise": 5e-9, "fall": 5e-9, "period": 3.7e-8, "pulses": 200)", 1e-6},
};

class Impulse : public testing::TestWithParam<Pulse> {};
INSTANTIATE_TEST_SUITE_P(Pulses, Impulse, testing::ValuesIn(pulses),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_P(Impulse, IsTheIntegralOfTheFactorForAnyStep) {
  constexpr double pressure = 1e-4, area = 16e-6;  // so small that faces keep their area to 1e-14
  for (const double step : {1e-7, 0.93e-7, 0.31e-7}) {
    const auto plan =
        plan_of(scene(pressed(pressure, GetParam().time_function), explicit_to(10e-6, step)));
    const Result result = run_stages(*plan);
    EXPECT_EQ(result.time, 10e-6);
    const double expected = pressure * area * GetParam().integral;
    EXPECT_NEAR(result.last.momentum.z / expected, 1, 1e-12) << "step " << step;
    EXPECT_LT(result.largest_error, 1e-3);
  }
}

TEST(Impulse, IsExactAtEveryStep) {  // also in the middle of a jump
  const auto plan = plan_of(
      scene(stage("loads.expression", {{"on", "all"},
                                       {"total", {3, 0, 0}},
                                       {"expression", "t > 1.03e-6 ? 2 - abs(t - 2e-6) * 1e5 : 0"},
                                       {"corners", {1.03e-6, 2e-6}}}),
            explicit_to(10e-6, 1e-7)));
  Simulation simulation(*plan->model, 1);
  const auto integral = [](double t) {
    const auto leg = [](double x) { return 2 * x - 1e5 * x * std::abs(x) / 2; };
    return t > 1.03e-6 ? 3 * (leg(t - 2e-6) - leg(1.03e-6 - 2e-6)) : 0;
  };
  for (int n = 0; n < 40; ++n) {
    simulation.step(1e-7);
    EXPECT_NEAR(simulation.balance().momentum.x, integral(simulation.time()),
                1e-12 * integral(4e-6))
        << n;
  }
}

TEST(Mean, OfAFactorOverAnyLength) {
  const auto plan = plan_of(scene(
      pressed(1, {{"form", "harmonic"}, {"frequency", 1e6}}) + pressed(1, {{"form", "triangle"},
                                                                           {"rise", 1e-7},
                                                                           {"fall", 3e-7},
                                                                           {"period", 1e-6},
                                                                           {"pulses", 200}}),
      explicit_to(10e-6, 0.4e-7)));
  const Load &harmonic = plan->model->loads[0], &train = plan->model->loads[1];
  EXPECT_EQ(harmonic.frequency, 1e6);
  EXPECT_EQ(train.frequency, 0);
  const double phase = 2 * std::numbers::pi * 1e6;
  const auto exact = [&](double from, double to) {
    return (std::cos(phase * from) - std::cos(phase * to)) / phase;
  };
  EXPECT_NEAR(harmonic.mean(3.3e-6, 3.4e-6), exact(3.3e-6, 3.4e-6) / 1e-7, 1e-13);
  EXPECT_NEAR(harmonic.integral(0.2e-6, 50.4e-6), exact(0.2e-6, 50.4e-6), 1e-12 * 50e-6);
  EXPECT_NEAR(train.integral(0, 2e-3), 200 * 2e-7, 1e-12 * 4e-5);
  EXPECT_NEAR(train.mean(0, 100e-6), 0.2, 1e-12);
  EXPECT_EQ(train.mean(5.5e-6, 5.6e-6), 0);
  const Load::Limit rising = train.limit(2e-6, 1e-7), before = train.limit(2e-6, -1e-7),
                    falling = train.limit(2.1e-6, 1e-7);
  EXPECT_NEAR(rising.slope, 1e7, 1);
  EXPECT_NEAR(rising.value, 0, 1e-9);
  EXPECT_EQ(before.slope, 0);
  EXPECT_NEAR(falling.slope, -1 / 3e-7, 1);
}

// Springs of an undamped bar push in pulses. If steps changed at the corners of the load, the
// energy of the bar would grow without bound.
Stages train(const Keys& keys) {
  return fixed("z_max") + stage("loads.actuation",
                                Keys{{"on", "all"}, {"strain", 1e-4}, {"form", "triangle"}} + keys);
}
const Keys membrane = {{"poisson", 0.2}, {"membrane", "I-m"}};

TEST(Trains, KeepTheirEnergy) {
  const Stages loads = train({{"rise", 1e-6}, {"fall", 1e-6}, {"period", 5e-6}, {"pulses", 400}});
  const auto plan = plan_of(scene(loads, explicit_to(2e-3), 6, 6, 12, membrane));
  const Result result = run_stages(*plan, 100);
  std::printf("%llu steps, largest error of the balance %.1e of %.3g J\n",
              static_cast<unsigned long long>(result.steps), result.largest_error,
              result.last.scale);
  EXPECT_GT(result.steps, 4000u);
  EXPECT_LT(result.largest_error, 1e-3);
  EXPECT_LT(result.last.kinetic + result.last.stored, 2e-3);
}

TEST(Trains, OfPulsesShorterThanAStepKeepTheirEnergy) {
  const Stages loads = train({{"rise", 5e-8}, {"fall", 5e-8}, {"period", 1e-6}, {"pulses", 1000}});
  const auto plan = plan_of(scene(loads, explicit_to(1e-3), 6, 6, 12, membrane));
  const Result result = run_stages(*plan, 100);
  EXPECT_LT(result.largest_error, 1e-3);
}

TEST(Trains, StepsThatDivideTheStageAreTakenAsTheyAre) {
  const auto plan = plan_of(scene({}, explicit_to(1e-3, 50e-9), 2, 2, 2));
  EXPECT_EQ(plan->steps(), 20000u);
  const Result result = run_stages(*plan, 1000);
  EXPECT_EQ(result.steps, 20000u);
  EXPECT_EQ(result.time, 1e-3);
}

/// Displacements, after 6 us, of a shaken block in small motion. Its three stages have steps of
/// different fractions of `unit`.
std::vector<double> after_stages(double unit, double* largest_error = nullptr) {
  const auto plan = plan_of(scene(
      fixed("z_min") + force("z_max", {0, 1, 2}, {{"rise", 5e-6}}),
      explicit_to(2e-6, unit) + explicit_to(4e-6, 0.4 * unit) + explicit_to(6e-6, 0.8 * unit)));
  Simulation simulation(*plan->model, 1);
  const double k = std::numbers::pi / 5e-3;
  std::vector<double> v;
  for (Particle p = 0; p < plan->model->body.particles; ++p) {
    const double z = plan->model->body.position(p).z - 0.5e-3;
    v.insert(v.end(), {0.02 * std::sin(k * z), 0, 0.01 * std::sin(k * z)});
  }
  simulation.set_velocities(v, {});
  for (const PlannedStage& stage : plan->stages) {
    StageCalls::Hooks hooks;
    hooks.observe = [&] {
      if (largest_error != nullptr)
        *largest_error = std::max(*largest_error, std::abs(simulation.balance().relative_error()));
    };
    StageCalls(*plan->model, simulation, stage, 1, std::move(hooks)).run();
  }
  return displacements(simulation);
}

TEST(Stages, OfUnlikeStepsAreOfSecondOrderAndLoseNothing) {
  double error = 0;
  const std::vector<double> coarse = after_stages(2e-7, &error), half = after_stages(1e-7),
                            quarter = after_stages(0.5e-7);
  const double order = std::log2(distance(coarse, half) / distance(half, quarter));
  std::printf("stages of unlike steps: order %.2f, largest error of the balance %.1e\n", order,
              error);
  EXPECT_NEAR(order, 2, 0.15);
  EXPECT_LT(error, 1e-7);
}

/// Injected work and momentum after 3 us of driven motion. With `stage_before` the motion starts
/// from a state of rest.
std::pair<double, double> driven(double step, const Stages& load, bool stage_before) {
  const Stages rest = stage_before ? stage("solvers.static", {{"end_time", 0}}) : Stages{};
  const auto plan = plan_of(scene(load, rest + explicit_to(3e-6, step)));
  const Result result = run_stages(*plan, 1);
  EXPECT_LT(result.largest_error, 1e-5) << load.json() << stage_before;
  return {result.last.injected, result.last.momentum.z};
}

TEST(DrivenMotion, BeginsToSecondOrder) {
  const Keys driven_end = {{"on", "z_max"}, {"rise", 2e-6}};
  for (const Stages& load :
       {stage("loads.velocity", driven_end + Keys{{"value", {0, 0, 0.01}}}),
        stage("loads.displacement", driven_end + Keys{{"value", {0, 0, 2e-8}}})})
    for (const bool stage_before : {false, true}) {
      const auto coarse = driven(2e-7, load, stage_before), half = driven(1e-7, load, stage_before),
                 quarter = driven(0.5e-7, load, stage_before);
      const double of_work =
          std::abs(coarse.first - half.first) / std::abs(half.first - quarter.first);
      const double of_momentum =
          std::abs(coarse.second - half.second) / std::abs(half.second - quarter.second);
      std::printf("half the step, errors of work by %.2f, of momentum by %.2f\n", of_work,
                  of_momentum);
      EXPECT_GT(of_work, 3);
      EXPECT_GT(of_momentum, 3);
    }
}

// A force acts on held particles before any particle moves.
TEST(Balance, IsNotMeasuredAgainstRoundOff) {
  const Stages loads = fixed("z_max") + force("z_max", {0, 0, -500}) +
                       stage("loads.expression", {{"on", "z_min"},
                                                  {"expression", "t > 10e-6 ? 1 : 0"},
                                                  {"corners", {10e-6}},
                                                  {"total", {0, 0, -100}}});
  const auto plan = plan_of(scene(loads, explicit_to(4e-5), 6, 6, 12, membrane));
  EXPECT_LT(run_stages(*plan, 1).largest_error, 1e-4);
  const auto at_rest =
      plan_of(scene(loads, stage("solvers.relaxation", {{"end_time", 9e-6}}), 6, 6, 12, membrane));
  EXPECT_LT(run_stages(*at_rest, 1).largest_error, 1e-4);
}

TEST(Balance, IsNotMeasuredAgainstRoundOffOfWhatGravityDoesToHeldParticles) {
  for (const char* held : {R"("on": "all")", R"("on": "all", "axes": "z")"}) {
    const auto plan = plan_of(scene(stage("loads.fixed", held) + stage("loads.gravity"),
                                    explicit_to(4e-5), 6, 6, 12, membrane));
    EXPECT_LT(run_stages(*plan, 1).largest_error, 1e-4) << held;
  }
}

TEST(ForceOnALoad, HoldsWhatOthersDoToItsParticles) {
  const auto plan =
      plan_of(scene(fixed("z_max") + force("z_max", {0, 0, -500}), explicit_to(1e-6, 1e-7)));
  Simulation simulation(*plan->model, 1);
  for (int n = 0; n < 3; ++n) simulation.step(1e-7);
  EXPECT_NEAR(simulation.force_on_load()[0].z, -500, 1e-9);
  for (const double work : simulation.injected_by_load()) EXPECT_EQ(work, 0);
}

Stages expression_load(const char* expression, const Keys& more = {}) {
  return stage("loads.expression",
               Keys{{"on", "z_min"}, {"total", {0, 0, 1}}, {"expression", expression}} + more);
}

TEST(LoadsThatAreNoNumbers, AreNamedWithTheirText) {
  for (const char* expression : {"sqrt(3e-7 - t)", "1 / t", "sqrt(-1)", "t > 4e-7 ? 1 / 0 : 1"}) {
    const auto plan =
        plan_of(scene(fixed("z_max") + expression_load(expression), explicit_to(1e-6, 1e-7)));
    try {
      run_stages(*plan, 1);
      FAIL() << expression;
    } catch (const RunError& error) {
      const std::string sentence = error.what();
      for (const char* part : {"loads.expression (/pipeline/3)", expression, "t = "})
        EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
    }
  }
}

std::string faults_of_scene(const std::string& text) {
  try {
    plan_of(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Resolution, OfExpressionsFasterThanTheStepIsToldByThePlan) {
  const auto warnings = [](const char* expression, const Keys& more = {}) {
    return plan_of(scene(expression_load(expression, more), explicit_to(1e-5, 1e-7)))
        ->model->warnings;
  };
  for (const char* slow : {"1", "t", "sin(1e6 * t)", "exp(-t / 1e-6)"})
    EXPECT_TRUE(warnings(slow).empty()) << slow;
  EXPECT_TRUE(
      warnings("(t > 2.11e-6 && t < 2.12e-6) ? 1 : 0", {{"corners", {2.11e-6, 2.12e-6}}}).size() <=
      1);
  for (const char* fast :
       {"sin(1e9 * t)", "exp(-((t - 5.02e-6) / 4e-9)^2)", "(t > 2.11e-6 && t < 2.15e-6) ? 1 : 0"}) {
    const auto found = warnings(fast);
    ASSERT_FALSE(found.empty()) << fast;
    EXPECT_NE(found.front().find("its impulse is not exact"), std::string::npos) << found.front();
  }
}

/// A jump between two steps, within one or in a long run is found; kinks and steep slopes are none.
TEST(Resolution, JumpsOfExpressionsWithoutCornersAreToldByThePlan) {
  const auto warnings = [](const std::string& expression, double step, const Keys& more = {}) {
    return plan_of(scene(expression_load(expression.c_str(), more), explicit_to(1e-5, step)))
        ->model->warnings;
  };
  for (const double step : {1e-7, 7e-8})
    for (const char* at : {"5e-6", "1.234567e-6", "9.99e-6"}) {
      const std::string jump = std::string("t < ") + at + " ? 1 : 0";
      const auto found = warnings(jump, step);
      ASSERT_FALSE(found.empty()) << jump << step;
      EXPECT_NE(found.front().find("it jumps"), std::string::npos) << found.front();
      for (const std::string& warning :
           warnings(jump, step, {{"corners", Json::array({std::stod(at)})}}))
        EXPECT_EQ(warning.find("it jumps"), std::string::npos) << jump << step;
    }
  for (const char* smooth : {"sqrt(t)", "abs(t - 5e-6)", "sin(3e5 * t)", "tanh((t - 5e-6) / 1e-6)"})
    for (const std::string& warning : warnings(smooth, 1e-7))
      EXPECT_EQ(warning.find("it jumps"), std::string::npos) << smooth;
}

// A short rest before a load begins is none of its changes; a short pulse is one.
TEST(Resolution, ARestBeforeALoadIsNoFastChange) {
  const auto is_told = [](const char* expression, const Json& corners) {
    const auto plan = plan_of(
        scene(expression_load(expression, {{"corners", corners}}), explicit_to(1e-5, 1e-7)));
    const auto& warnings = plan->model->warnings;
    return std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
      return warning.find("it changes within") != std::string::npos;
    });
  };
  EXPECT_FALSE(is_told("t < 1.5e-7 ? 0 : 1", {1.5e-7}));
  EXPECT_TRUE(is_told("t < 1.5e-7 ? 0 : (t < 3e-7 ? 1 : 0)", {1.5e-7, 3e-7}));
}

TEST(Resolution, OfLoadsIsToldByThePlan) {
  const auto with = [](const Keys& keys, double step) {
    return scene(pressed(1, keys), explicit_to(10e-6, step));
  };
  const auto warnings = [&](const Keys& keys) {
    return plan_of(with(keys, 1e-7))->model->warnings;
  };
  EXPECT_NE(faults_of_scene(with(R"("form": "harmonic", "frequency": 6e6)", 1e-7))
                .find("/pipeline/2: 6e+06 Hz: expected at most 5e+06 Hz"),
            std::string::npos)
      << faults_of_scene(with(R"("form": "harmonic", "frequency": 6e6)", 1e-7));
  EXPECT_EQ(faults_of_scene(with(R"("form": "harmonic", "frequency": 5e6)", 1e-7)), "");
  EXPECT_TRUE(warnings(R"("form": "harmonic", "frequency": 5e5)").empty());
  EXPECT_TRUE(warnings(R"("form": "triangle", "rise": 2e-7, "fall": 2e-7)").empty());
  EXPECT_TRUE(warnings(R"("form": "constant", "duration": 5e-6)").empty());
  EXPECT_TRUE(
      warnings(R"("form": "triangle", "rise": 1e-6, "fall": 1e-6, "period": 2e-6, "pulses": 4)")
          .empty());
  Json times, values;  // the samples are closer than steps, and their shape varies slowly
  for (int n = 0; n <= 100; ++n) {
    times.push_back(n * 5e-8);
    values.push_back(std::sin(std::numbers::pi * n / 100));
  }
  EXPECT_TRUE(warnings({{"form", "table"}, {"times", times}, {"values", values}}).empty());
  for (const char* keys :
       {R"("form": "harmonic", "frequency": 1e6)",
        R"("form": "triangle", "rise": 1e-7, "fall": 1e-6)",
        R"("form": "constant", "duration": 1e-9)",
        R"("form": "triangle", "rise": 1e-9, "fall": 1e-9, "period": 1e-7, "pulses": 9)"}) {
    const std::vector<std::string> told = warnings(keys);
    ASSERT_EQ(told.size(), 1u) << keys;
    EXPECT_NE(told[0].find("/pipeline/2"), std::string::npos) << told[0];
  }
}

}  // namespace impulse_test
