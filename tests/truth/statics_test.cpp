// States of rest against closed forms: contrasts of stiffness, stretches to three times the length,
// loads near round-off, and bodies far from the origin. Relaxation, time steps and the static
// solver must find the same state of rest.
#include <support/rest.hpp>

#include <gtest/gtest.h>

namespace statics_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

const Keys membrane_I_m = {{"membrane", "I-m"}, {"poisson", 0.1}};

Stages statics(double tolerance, const Keys& more = {}) {
  return stage("solvers.static", Keys{{"tolerance", tolerance}} + more);
}

// In uniaxial strain every layer of a bar has the same stress: u = sigma (L1 / M1 + L2 / M2) with
// the confined moduli M1 and M2. A spring between two materials is half of each, so that the border
// lies half a spacing from the last soft layer.
TEST(Statics, ABarOfTwoMaterialsIsASeriesOfSprings) {
  constexpr double l = 0.005, sigma = 1e4, young = 1e9, nu = 0.2,
                   confined = (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  for (const double contrast : {1.0, 1e4, 1e6}) {
    const Keys membrane = {{"poisson", 0.2}, {"membrane", "I-m"}};
    const AtRest bar(
        SceneBuilder{}
            .lattice("lattices.cubic", l, box({}, {2 * l, 2 * l, 40 * l}), {{"boundary", "cells"}})
            .stages(elastic(young, membrane))
            .stages(elastic(young * contrast,
                            membrane + Keys{{"region", box({-1, -1, 19 * l}, {1, 1, 1})}}))
            .load("loads.fixed", {{"on", "all"}, {"axes", "xy"}})
            .load("loads.fixed", {{"on", "z_min"}, {"axes", "z"}, {"name", "end"}})
            .load("loads.pressure", {{"on", "z_max"}, {"facing", "z_max"}, {"pressure", -sigma}})
            .stages(to_rest)
            .text());
    const double expected = sigma / (young * confined) * (19 * l + 21 * l / contrast);
    EXPECT_NEAR(bar.mean(2, [](Site s) { return s.k == 40; }) / expected, 1, 0.01) << contrast;
    EXPECT_LT(bar.report.iterations, 200u) << contrast;
    std::printf("contrast %g: %llu iterations, error %.2e\n", contrast,
                static_cast<unsigned long long>(bar.report.iterations),
                bar.mean(2, [](Site s) { return s.k == 40; }) / expected - 1);
  }
}

// Truth: finite elements, two meshes that agree to 0.3 %; mean over the outer layer of particles.
TEST(Statics, AnInclusionUpToAMillionTimesAsStiff) {
  const std::pair<double, double> truth[] = {{1, 4.75e-5},
                                             {1e2, 4.0854589512414604e-5},
                                             {1e4, 4.062640882070169e-05},
                                             {1e6, 4.0623971063233974e-05}};
  double before = HUGE_VAL, last_but_one = 0;
  for (const auto& [contrast, expected] : truth) {
    const Keys membrane = {{"poisson", 0.2}, {"membrane", "I-m"}, {"stiffness", "eq15"}};
    const Json inclusion = box({0.03, 0.03, 0.03}, {0.07, 0.07, 0.07});
    // No support holds the cube; the solver removes the rigid motions.
    const AtRest cube(
        SceneBuilder{}
            .lattice("lattices.cubic", 0.005, box({}, {0.1, 0.1, 0.1}))
            .stages(elastic(1e9, membrane))
            .stages(elastic(1e9 * contrast, membrane + Keys{{"region", inclusion}}))
            .load("loads.pressure", {{"on", "x_min"}, {"pressure", -1e6}})
            .load("loads.pressure", {{"on", "x_max"}, {"pressure", -1e6}, {"name", "other"}})
            .stages(to_rest)
            .text());
    const double grown = (cube.mean(0, [](Site s) { return s.i == 19; }) -
                          cube.mean(0, [](Site s) { return s.i == 0; })) /
                         2;
    std::printf("contrast %g: %llu iterations, error %.3f\n", contrast,
                static_cast<unsigned long long>(cube.report.iterations), grown / expected - 1);
    EXPECT_NEAR(grown / expected, 1, 0.08) << contrast;
    EXPECT_LT(grown, before);
    if (contrast == 1e6) {
      EXPECT_NEAR(grown / last_but_one, 1, 1e-3);
    }
    last_but_one = before = grown;
  }
}

/// Rows of a table of numbers.
std::vector<std::vector<double>> table(const std::string& name) {
  std::ifstream file(std::string(HYPERLATTICE_SOURCE) + "/tests/data/" + name);
  std::vector<std::vector<double>> rows;
  std::string line, cell;
  for (std::getline(file, line); std::getline(file, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    while (std::getline(cells, cell, ',')) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

// A body of cells between frictionless platens stretches homogeneously. Its response is that of the
// infinite lattice with exact geometry (closed form).
TEST(Statics, StretchedLikeTheEndlessLattice) {
  struct Case {
    const char *file, *material;
    double stretch, tolerance;
  };
  for (const Case& c : {Case{"stretch_nu0.25.csv", R"("membrane": "none")", 3, 1e-8},
                        {"stretch_nu0.25.csv", R"("membrane": "none")", 0.8, 1e-8},
                        {"stretch_nu0.1.csv", R"("membrane": "I-m", "poisson": 0.1)", 2, 1e-8},
                        {"stretch_nu0.1.csv", R"("membrane": "I-m", "poisson": 0.1)", 0.8, 1e-8}}) {
    const auto rows = table(c.file);
    const auto row = std::find_if(rows.begin(), rows.end(),
                                  [&](const auto& r) { return std::abs(r[0] - c.stretch) < 1e-9; });
    ASSERT_NE(row, rows.end()) << c.stretch;
    const bool has_height =
        row->size() > 4 && std::string(c.material).find("I-m") != std::string::npos;
    const AtRest cube(SceneBuilder{}
                          .lattice("lattices.cubic", 1, box({}, {4, 4, 4}), {{"boundary", "cells"}})
                          .stages(elastic(1e9, c.material))
                          .load("loads.fixed", {{"on", "x_min"}, {"axes", "x"}})
                          .load("loads.displacement", {{"on", "x_max"},
                                                       {"axes", "x"},
                                                       {"rise", 1},
                                                       {"value", Vec3{4 * (c.stretch - 1), 0, 0}}})
                          .stages(statics(1e-11, {{"load_steps", 10}}))
                          .text());
    const double lateral = 1 + (cube.mean(1, [](Site s) { return s.j == 4; }) -
                                cube.mean(1, [](Site s) { return s.j == 0; })) /
                                   4;
    const double pulled = -cube.simulation->force_on_load().at(1).x / 16 /
                          cube.model().materials[0].constants.base_stiffness;
    EXPECT_NEAR(lateral, (*row)[1], 1e-8) << c.file << " " << c.stretch;
    EXPECT_NEAR(pulled, (*row)[3], 1e-8 * std::abs((*row)[3]) + 1e-9) << c.file << " " << c.stretch;
    if (has_height) {
      EXPECT_NEAR(1 + 2 * cube.heights.at(0), (*row)[2], 1e-8) << c.stretch;
    }
  }
}

// Far from the ends, the bar of two by two particles obeys 2 b - 1 = sqrt(2) b / s, F = k l [4 (a -
// 1) + 8 (1 - sqrt(2) / s) a], s^2 = a^2 + b^2.
TEST(Statics, ABarOfTwoByTwoParticlesAtThreeTimesItsLength) {
  const AtRest bar(
      SceneBuilder{}
          .lattice("lattices.cubic", 1, box({}, {2, 2, 60}))
          .stages(elastic(1e9, {{"membrane", "none"}}))
          .load("loads.fixed", {{"on", "z_min"}})
          .load("loads.displacement", {{"on", "z_max"}, {"value", {0, 0, 118}}, {"rise", 1}})
          .stages(statics(1e-10, {{"load_steps", 20}}))
          .text());
  const auto level = [&](int k) { return bar.mean(2, [k](Site s) { return s.k == k; }); };
  const double a = 1 + (level(35) - level(25)) / 10;
  const double b = 1 + bar.mean(0, [](Site s) { return s.k == 30 && s.i == 1; }) -
                   bar.mean(0, [](Site s) { return s.k == 30 && s.i == 0; });
  const double s = std::hypot(a, b), force = 4 * (a - 1) + 8 * (1 - std::sqrt(2.0) / s) * a;
  EXPECT_NEAR(2 * b - 1, std::sqrt(2.0) * b / s, 1e-6);
  EXPECT_NEAR(-bar.simulation->force_on_load().at(1).z /
                  bar.model().materials[0].constants.base_stiffness / force,
              1, 1e-6);
  EXPECT_GT(a, 2.9);
}

/// Displacements times young / force of a small L of 1 mm particles, which is held at one end and
/// pulled at the other by a force (N).
std::vector<double> response(double force, double young, double from = 0) {
  const double l = 1e-3;
  const auto at = [&](double x, double y, double z) { return Vec3{from + x * l, y * l, z * l}; };
  const Json shape = {{"union", {box(at(0, 0, 0), at(10, 3, 3)), box(at(0, 0, 0), at(3, 10, 3))}}};
  const AtRest body(SceneBuilder{}
                        .lattice("lattices.cubic", l, shape, {{"anchor", Vec3{from, 0, 0}}})
                        .stages(elastic(young, membrane_I_m))
                        .load("loads.fixed", {{"on", "x_max"}})
                        .load("loads.force", {{"on", "y_max"}, {"total", Vec3{force, 0, force}}})
                        .stages(to_rest)
                        .text());
  std::vector<double> scaled = body.u;
  for (double& value : scaled) value *= young / force;
  return scaled;
}

TEST(Statics, TinyLoadsStiffBodiesAndFarOnesRespondAlike) {
  const auto nominal = response(1e-4, 1e10);
  const double size = largest(nominal);
  EXPECT_LT(distance(nominal, response(1e-16, 1e10)), 1e-6 * size);
  EXPECT_LT(distance(nominal, response(1e1, 1e15)), 1e-6 * size);
  EXPECT_LT(distance(nominal, response(1e-4, 1e10, 1024)), 1e-9 * size);
}

TEST(Statics, NoLoadIsNoMotion) {
  const AtRest body(SceneBuilder{}
                        .lattice("lattices.cubic", 1, box({}, {4, 4, 4}))
                        .stages(elastic(1e9, membrane_I_m))
                        .load("loads.fixed", {{"on", "x_max"}})
                        .stages(to_rest)
                        .text());
  EXPECT_EQ(largest(body.u), 0);
}

std::string pulled_block(const Stages& solver, int n = 8) {
  return block(n, n, 2 * n, membrane_I_m,
               stage("loads.fixed", {{"on", "z_min"}}) +
                   stage("loads.force", {{"on", "z_max"}, {"total", {100, 0, 300}}}) + solver);
}

// The coarse levels of multigrid store one block for all sites with equal springs. In a slightly
// deformed body every site has its own block. Both must give the same levels, hence the same
// iterations and displacements.
TEST(Statics, SitesThatAreAlikeAreKeptOnce) {
  const Json shape = {{"difference", {box_mm(12, 13, 21), box({4e-3, 0, 5e-3}, {8e-3, 1, 9e-3})}}};
  const Json stiff_part = box({0, 0, 9e-3}, {1, 1, 14e-3});
  const auto plan =
      plan_of(SceneBuilder{}
                  .lattice("lattices.cubic", 1e-3, shape)
                  .stages(elastic(1e9, membrane_I_m))
                  .stages(elastic(1e11, membrane_I_m + Keys{{"region", stiff_part}}))
                  .load("loads.fixed", {{"on", "z_min"}, {"axes", "xz"}})
                  .load("loads.fixed", {{"on", "x_min"}, {"axes", "y"}})
                  .load("loads.force", {{"on", "z_max"}, {"total", {1e-4, 0, 3e-4}}, {"rise", 2}})
                  .stages(statics(1e-8, {{"stability", false}, {"end_time", 1}}))
                  .stages(statics(1e-8, {{"stability", false}, {"end_time", 2}}))
                  .text(),
              1);
  Simulation simulation(*plan->model, 1);
  std::vector<std::uint64_t> iterations;
  std::vector<std::vector<double>> u;
  for (const PlannedStage& stage : plan->stages) {
    RestReport last;
    StageCalls::Hooks hooks;
    hooks.report = [&](const RestReport& report) { last = report; };
    StageCalls(*plan->model, simulation, stage, 1, std::move(hooks)).run();
    iterations.push_back(last.iterations);
    u.push_back(displacements(simulation));
  }
  EXPECT_NEAR(static_cast<double>(iterations[0]), static_cast<double>(iterations[1]),
              1);  // the eigenvalue bound differs
  for (double& value : u[0]) value *= 2;
  EXPECT_LT(distance(u[0], u[1]), 1e-6 * largest(u[1]));
  std::printf("%llu and %llu iterations\n", static_cast<unsigned long long>(iterations[0]),
              static_cast<unsigned long long>(iterations[1]));
}

TEST(Statics, RelaxationAgrees) {
  const AtRest found(pulled_block(to_rest));
  for (const char* method : {"local_damping", "accelerated"}) {
    AtRest relaxed(
        pulled_block(stage("solvers.relaxation", {{"tolerance", 1e-7}, {"method", method}})));
    EXPECT_LT(distance(found.u, relaxed.u), 1e-4 * largest(found.u)) << method;
    std::printf("%s: %llu steps, largest error %.1e\n", method,
                static_cast<unsigned long long>(relaxed.report.iterations),
                distance(found.u, relaxed.u) / largest(found.u));
    EXPECT_LT(std::abs(relaxed.simulation->balance().relative_error()), 1e-3) << method;
  }
}

std::string small_block(const Stages& stages) {
  return SceneBuilder{}
      .lattice("lattices.cubic", 1e-3, box_mm(6, 4, 4))
      .stages(elastic(1e9, membrane_I_m))
      .load("loads.fixed", {{"on", "x_min"}})
      .stages(stages)
      .text();
}

// A driven particle ends where its motion leads at the end time, however many steps the solver
// takes. At 1 mm/s for 1 ms this is 1 um, and half of it if the rise takes the whole time.
TEST(Statics, WhatIsDrivenComesWhereItWouldHaveComeByThen) {
  const auto driven = [](const Keys& rise, const char* solver, const Keys& keys) {
    const Keys load = {{"on", "x_max"}, {"value", {1e-3, 0, 0}}};
    return AtRest(small_block(stage("loads.velocity", load + rise) +
                              stage(solver, keys + Keys{{"end_time", "1 ms"}})));
  };
  for (const auto& [rise, way] : {std::pair{"", 1e-6}, {R"("rise": "1 ms")", 0.5e-6}}) {
    const AtRest found = driven(rise, "solvers.static", {{"tolerance", 1e-8}});
    EXPECT_NEAR(largest(found.u), way, 1e-12 * way) << rise;
    for (const char* method : {"local_damping", "accelerated"}) {
      const AtRest relaxed =
          driven(rise, "solvers.relaxation", {{"tolerance", 1e-6}, {"method", method}});
      EXPECT_NEAR(largest(relaxed.u), way, 1e-12 * way) << rise << method;
      EXPECT_LT(distance(found.u, relaxed.u), 1e-3 * way) << rise << method;
    }
  }
}

/// A force on x_max whose factor is an expression of the time.
Stages pull(const char* expression, const Keys& more = {}) {
  return stage("loads.expression",
               Keys{{"on", "x_max"}, {"total", {1, 0, 0}}, {"expression", expression}} + more);
}

// If a load jumps at the instant of the state of rest, the value after the jump counts.
TEST(Statics, ALoadThatJumpsAtTheInstantOfRestHasJumped) {
  for (const char* solver : {"solvers.static", "solvers.relaxation"}) {
    const auto pulled = [&](const char* expression) {
      return AtRest(small_block(pull(expression, {{"corners", {"10 us"}}}) + stage(solver)));
    };
    const AtRest whole = pulled("1");
    EXPECT_GT(largest(whole.u), 0);
    EXPECT_EQ(whole.u, pulled("t>10e-6?1:0").u) << solver;
    EXPECT_EQ(whole.u, pulled("t>=10e-6?1:0").u) << solver;
  }
}

TEST(Statics, ALoadThatIsNoNumberIsNamed) {
  for (const char* expression : {"sqrt(0.5-t)", "exp(t*1500)"}) {
    try {
      const AtRest found(
          small_block(pull(expression) + stage("solvers.static", {{"end_time", 1}})));
      FAIL() << expression;
    } catch (const RunError& error) {
      EXPECT_NE(std::string(error.what()).find(expression), std::string::npos) << error.what();
    }
  }
}

// The reported error must be right also where the residual is a poor measure: in the slender beam,
// 1e-4 of the mean force is 3 % of the displacements.
TEST(Statics, RelaxationKnowsItsError) {
  const auto bent_beam = [](const Stages& solver) {
    return block(40, 4, 4, membrane_I_m,
                 stage("loads.fixed", {{"on", "x_min"}}) +
                     stage("loads.force", {{"on", "x_max"}, {"total", {0, 1e-3, 0}}}) + solver);
  };
  for (const bool slender : {false, true}) {
    const auto body = [&](const Stages& solver) {
      return slender ? bent_beam(solver) : pulled_block(solver);
    };
    const AtRest found(body(to_rest));
    for (const char* method : {"local_damping", "accelerated"})
      for (const char* asked : {R"("tolerance": 1e-3)", R"("tolerance": 1e-5)",
                                R"("tolerance": 1, "displacement_error": 0.01)"}) {
        const AtRest relaxed(body(stage("solvers.relaxation", asked + Keys{{"method", method}})));
        double wrong = 0, all = 0;
        for (std::size_t n = 0; n < found.u.size(); ++n) {
          wrong += std::pow(relaxed.u[n] - found.u[n], 2);
          all += found.u[n] * found.u[n];
        }
        const double error = std::sqrt(wrong / all), told = relaxed.report.displacement_error;
        std::printf("%s, %s, %s: error %.2e, told %.2e\n", slender ? "beam" : "block", method,
                    asked, error, told);
        EXPECT_GT(told, 0.9 * error) << method << asked;
        EXPECT_LT(told, (method == std::string("accelerated") ? 1.5 : 20) * error)
            << method << asked;
      }
  }
}

TEST(Statics, StepsInTimeFindTheBodyAtRest) {
  AtRest body(pulled_block(to_rest));
  const double stored = body.simulation->balance().stored;
  body.simulation->set_damping(0);
  for (int n = 0; n < 200; ++n) body.simulation->step(0.9 * body.model().step_limit.time_step);
  const EnergyBalance end = body.simulation->balance();
  EXPECT_LT(end.kinetic_mean, 1e-12 * stored);
  EXPECT_NEAR(end.stored / stored, 1, 1e-7);
  EXPECT_LT(distance(body.u, displacements(*body.simulation)), 1e-6 * largest(body.u));
}

TEST(Statics, WorkOfTheLoadsIsWhatIsStored) {
  AtRest body(pulled_block(statics(1e-8, {{"load_steps", 8}})));
  const EnergyBalance balance = body.simulation->balance();
  // The trapezoidal rule is of second order; a single step has an error of 4e-3.
  EXPECT_NEAR(balance.injected / balance.stored, 1, 1e-4);
  EXPECT_EQ(body.simulation->steps(), 8u);
}

TEST(Statics, ResultsDoNotDependOnThreads) {
  const std::string scene = pulled_block(statics(1e-5), 34);
  const AtRest one(scene, 1), three(scene, 3);
  EXPECT_EQ(one.simulation->hash(), three.simulation->hash());
  EXPECT_EQ(one.report.iterations, three.report.iterations);
}

TEST(Statics, IterationsDoNotGrowWithTheBody) {
  const auto iterations = [](int n) {
    return AtRest(pulled_block(statics(1e-6), n)).report.iterations;
  };
  const auto coarse = iterations(6);
  EXPECT_LE(iterations(24), coarse + 6);
}

}  // namespace statics_test
