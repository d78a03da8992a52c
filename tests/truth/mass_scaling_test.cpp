// Added mass that lengthens explicit steps: its amount against closed forms, stability, energy and
// momentum, frequencies against those of a chain, states of rest, and the same bits.
#include <base/errors.hpp>
#include <support/archives.hpp>
#include <support/motion.hpp>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <cmath>
#include <numbers>

namespace mass_scaling_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

struct Bar {
  double contrast = 1e4;
  Stages loads{};
  Keys solver{};
  double end = 6e-5;
  Keys scene{}, lattice{}, soft{};
  Stages more{};
};

/// A bar along x of 24 x 3 x 3 cells with a stiff layer, whose soft waves take 1 us a cell.
std::string text_of(const Bar& bar) {
  const Keys elastic{{"young", 1e9}, {"density", 1000}, {"poisson", 0.25}};
  SceneBuilder scene;
  for (const auto& [key, value] : bar.scene.json().items()) scene.key(key, value);
  scene.lattice("lattices.cubic", 1e-3, box_mm(24, 3, 3), bar.lattice)
      .material("materials.elastic", elastic + bar.soft);
  if (bar.contrast != 1)
    scene.material("materials.elastic", elastic +
                                            Keys{{"name", "stiff"},
                                                 {"region", box({9.9e-3, -1, -1}, {13.1e-3, 1, 1})},
                                                 {"young", 1e9 * bar.contrast}} +
                                            bar.soft);
  return scene.stages(bar.loads)
      .solver("solvers.explicit", Keys{{"end_time", bar.end}} + bar.solver)
      .stages(bar.more)
      .text();
}

Keys scaling(double time_step) { return {{"mass_scaling", time_step}}; }

/// The critical step of the bar without a stiff layer.
double soft_step(const Keys& lattice = {}) {
  return Motion(text_of({.contrast = 1, .lattice = lattice})).critical();
}

const MassScaling& scaling_of(const Motion& run) { return *run.plan->stages.front().mass_scaling; }

Stages pushes() {
  return stage("loads.fixed", {{"on", box({11.4e-3, -1, -1}, {11.6e-3, 1, 1})}}) +
         stage("loads.gravity", {{"acceleration", {1000, 200, 0}}}) +
         stage("loads.velocity", {{"on", "x_max"}, {"value", {0.1, 0, 0}}, {"rise", 2e-5}}) +
         stage("loads.force", {{"on", box({10.4e-3, -1, -1}, {10.6e-3, 1, 1})},
                               {"total", {-3, 0, 0}},
                               {"rise", 2e-5}});
}

TEST(MassScaling, AddsWhatTheClosedFormsSay) {
  // One cell: its stiffest motion has omega = 2 / dt_c, and its eight corners are alike. A body of
  // one material inside: the same factor for all.
  for (const char* boundary : {"cells", "particles"}) {
    const auto text = [&](const Keys& solver) {
      return SceneBuilder()
          .lattice("lattices.cubic", 1e-3,
                   boundary == std::string("cells") ? box_mm(1, 1, 1) : box_mm(4, 3, 3),
                   {{"boundary", boundary}})
          .material("materials.elastic", {{"young", 1e9}, {"density", 1000}, {"poisson", 0.25}})
          .solver("solvers.explicit", Keys{{"end_time", 1e-5}} + solver)
          .text();
    };
    const Motion alone(text({}));
    const double step = 2.5 * alone.critical();
    const Motion run(text(scaling(step)));
    const MassScaling& found = scaling_of(run);
    EXPECT_EQ(found.particles().size(), run.model().body.particles);
    EXPECT_NEAR(found.share(), 2.5 * 2.5 - 1, 1e-9) << boundary;
    EXPECT_NEAR(found.largest_ratio(), 2.5 * 2.5, 1e-9) << boundary;
    double mass = 0;
    for (Particle p = 0; p < run.model().body.particles; ++p) mass += run.model().mass(p);
    EXPECT_NEAR(found.added(), 5.25 * mass, 1e-9 * mass) << boundary;
    const SolverPlan& plan = run.plan->stages.front().plan;
    EXPECT_NEAR(plan.stable_time_step, step, 1e-9 * step) << boundary;
  }
}

/// A line of particles along x; the middle spring's ends are stiff.
std::string chain(const Keys& solver, double contrast, const Stages& loads = {}) {
  const Keys elastic{{"young", 1e9}, {"density", 1000}, {"poisson", 0.25}};
  return SceneBuilder()
      .lattice("lattices.cubic", 1e-3, box_mm(40, 1, 1))
      .material("materials.elastic", elastic)
      .material("materials.elastic", elastic + Keys{{"name", "stiff"},
                                                    {"region", box({0.025, -1, -1}, {0.028, 1, 1})},
                                                    {"young", 1e9 * contrast}})
      .stages(loads)
      .solver("solvers.explicit", solver)
      .text();
}

/// Frequencies omega, 1/s, and motions of a chain along x that is held at its first particle.
Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> motions_of(const Motion& run) {
  const Model& model = run.model();
  const auto size = static_cast<Eigen::Index>(model.body.particles);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size), mass = stiffness;
  for (Eigen::Index p = 0; p < size; ++p) {
    mass(p, p) = run.simulation.inertia(static_cast<Particle>(p));
    if (p + 1 == size) continue;
    std::uint32_t along = 0;
    while (model.body.neighbours[along].dx != 1 || model.body.neighbours[along].dy != 0 ||
           model.body.neighbours[along].dz != 0)
      ++along;
    const double k =
        model.spring_properties(static_cast<Particle>(p), static_cast<Particle>(p + 1), along)
            .stiffness;
    stiffness(p, p) += k;
    stiffness(p + 1, p + 1) += k;
    stiffness(p, p + 1) -= k;
    stiffness(p + 1, p) -= k;
  }
  const Eigen::Index free = size - 1;
  return {Eigen::MatrixXd(stiffness.bottomRightCorner(free, free)),
          Eigen::MatrixXd(mass.bottomRightCorner(free, free))};
}

TEST(MassScaling, LowersTheFirstFrequencyAsTheMassPredicts) {
  const Stages held = stage("loads.fixed", {{"on", "x_min"}});
  const double step = Motion(chain({{"end_time", 1e-3}}, 1 + 1e-9)).critical();
  double before = 0, rayleigh = 0;
  for (const bool scaled : {false, true}) {
    Motion run(chain(Keys{{"end_time", 1e-3}} + (scaled ? scaling(step) : Keys{}), 4, held));
    const double added = scaled ? step : 0;
    run.simulation.set_added_mass(added);
    const auto motions = motions_of(run);
    const double omega = std::sqrt(motions.eigenvalues()[0]);
    if (!scaled) {
      before = omega;
      // By Rayleigh's quotient of the motion without added mass.
      const Motion heavy(chain(Keys{{"end_time", 1e-3}} + scaling(step), 4, held));
      double extra = 0, whole = 0;
      for (Particle p = 1; p < run.model().body.particles; ++p) {
        const double u = motions.eigenvectors()(static_cast<Eigen::Index>(p) - 1, 0);
        whole += run.model().mass(p) * u * u;
        for (const MassScaling::Heavy& of : scaling_of(heavy).particles())
          if (of.particle == p) extra += of.added * u * u;
      }
      rayleigh = 1 / std::sqrt(1 + extra / whole);
    }
    // The run starts in the first motion and passes zero after a quarter of a period.
    std::vector<double> u(3 * run.model().body.particles, 0);
    for (Particle p = 1; p < run.model().body.particles; ++p)
      u[3 * p] = 1e-9 * motions.eigenvectors()(static_cast<Eigen::Index>(p) - 1, 0) /
                 motions.eigenvectors().col(0).cwiseAbs().maxCoeff();
    run.simulation.set_displacements(u, {});
    double last = run.end(), last_time = 0, crossing = 0;
    run.go([&] {
      const double now = run.end();
      if (crossing == 0 && last * now < 0)
        crossing = last_time + (run.simulation.time() - last_time) * last / (last - now);
      last = now;
      last_time = run.simulation.time();
    });
    const double measured = std::numbers::pi / 2 / crossing;
    std::printf("%s added mass: omega %.6e, measured %.6e, %.4f of that without, Rayleigh %.4f\n",
                scaled ? "with" : "without", omega, measured, omega / before, rayleigh);
    EXPECT_NEAR(measured, omega, 2e-4 * omega);
    if (!scaled) continue;
    EXPECT_LT(omega / before, 0.98);
    EXPECT_NEAR(omega / before, rayleigh, 0.1 * (1 - rayleigh));
  }
}

struct Hold {
  double contrast;
  const char* boundary;
};
class Steps : public testing::TestWithParam<Hold> {};
INSTANTIATE_TEST_SUITE_P(Stiff, Steps,
                         testing::Values(Hold{1e4, "particles"}, Hold{1e6, "particles"},
                                         Hold{1e4, "cells"}, Hold{1e6, "cells"}));

TEST_P(Steps, HoldForAThousandAndKeepEnergyAndMomentum) {
  const Keys lattice{{"boundary", GetParam().boundary}};
  const double step = soft_step(lattice);
  Motion run(text_of({.contrast = GetParam().contrast,
                      .solver = scaling(step) + Keys{{"safety", 0.99}},
                      .end = 0.99 * 1000 * step,
                      .lattice = lattice}));
  EXPECT_GT(step, 0.5 * std::sqrt(GetParam().contrast) * run.critical());
  Simulation& simulation = run.simulation;
  simulation.set_velocities(noise(3 * run.model().body.particles, 1e-3, 3), {});
  Vec3 momentum;
  double first = 0, second = 0, least = infinity;  // largest energies in both halves of the run
  run.go([&] {
    const EnergyBalance now = simulation.balance();
    if (simulation.steps() == 0) momentum = now.momentum;
    double& largest =
        simulation.time() < 0.5 * run.plan->stages.front().plan.end_time ? first : second;
    largest = std::max(largest, now.kinetic + now.stored);
    least = std::min(least, now.kinetic + now.stored);
  });
  const EnergyBalance end = simulation.balance();
  std::printf("%zu particles of %llu, %.3g of the mass added; %llu steps, energies %.6e to %.6e\n",
              scaling_of(run).particles().size(),
              static_cast<unsigned long long>(run.model().body.particles), scaling_of(run).share(),
              static_cast<unsigned long long>(simulation.steps()), least, std::max(first, second));
  EXPECT_GE(simulation.steps(), 1000U);
  EXPECT_GT(first, 0);
  EXPECT_LT(second, (1 + 1e-4) * first);
  EXPECT_GT(least, (1 - 1e-3) * first);
  EXPECT_LT(norm(end.momentum - momentum), 1e-9 * std::sqrt(end.kinetic_mean));
  // Without the mass, the same steps destroy the body at once.
  EXPECT_GT(scaling_of(run).largest_ratio(), 0.1 * GetParam().contrast);
}

TEST(MassScaling, HoldsInLists) {
  // The few particles with the shortest springs dictate the step of a random lattice.
  const auto text = [](const Keys& solver) {
    return SceneBuilder()
        .lattice("lattices.random", 1e-3, box_mm(6, 6, 6))
        .material("materials.elastic", {{"young", 1e9}, {"density", 1000}, {"membrane", "none"}})
        .solver("solvers.explicit", Keys{{"safety", 0.99}} + solver)
        .text();
  };
  const double step = 1.5 * Motion(text({{"end_time", 1e-6}})).critical();
  Motion run(text(scaling(step) + Keys{{"end_time", 0.99 * 1000 * step}}));
  std::printf("%zu particles of %llu, %.3g of the mass added\n", scaling_of(run).particles().size(),
              static_cast<unsigned long long>(run.model().body.particles), scaling_of(run).share());
  EXPECT_GT(scaling_of(run).particles().size(), 0U);
  EXPECT_LT(scaling_of(run).particles().size(), run.model().body.particles);
  run.simulation.set_velocities(noise(3 * run.model().body.particles, 1e-3, 3), {});
  double first = 0, least = infinity, most = 0;
  run.go([&] {
    const EnergyBalance now = run.simulation.balance();
    if (first == 0) first = now.kinetic + now.stored;
    least = std::min(least, now.kinetic + now.stored);
    most = std::max(most, now.kinetic + now.stored);
  });
  EXPECT_GT(first, 0);
  EXPECT_LT(most, (1 + 1e-3) * first);
  EXPECT_GT(least, (1 - 1e-3) * first);
}

TEST(MassScaling, CountsWhatLoadsAnswer) {
  // A block falls on a floor whose contact is stiff: the particles at the floor get mass for it.
  const auto text = [](const Keys& solver) {
    return SceneBuilder()
        .lattice("lattices.cubic", 1e-3, box_mm(4, 4, 4))
        .material("materials.elastic", {{"young", 1e9}, {"density", 1000}, {"poisson", 0.25}})
        .load("loads.floor", {{"stiffness", 1e7}, {"point", {0, 0, -0.0001}}})
        .load("loads.gravity", {{"acceleration", {0, 0, -1000}}})
        .solver("solvers.explicit", Keys{{"end_time", 1e-3}} + solver)
        .text();
  };
  const Motion alone(text({}));
  const double step = alone.model().materials.front().critical_time_step;
  EXPECT_LT(alone.critical(), 0.7 * step);
  Motion run(text(scaling(step)));
  EXPECT_EQ(scaling_of(run).particles().size(), run.model().loads[0].watched.size());
  double largest = 0;
  run.go([&] { largest = std::max(largest, std::abs(run.simulation.balance().relative_error())); });
  EXPECT_GT(run.simulation.work_of_loads()[1], 0);
  std::printf("balance %.1e with %.3g of the mass added\n", largest, scaling_of(run).share());
  EXPECT_LT(largest, 0.02);
}

TEST(MassScaling, BalanceClosesWithAllKindsOfLoads) {
  for (const double damping : {0.0, 0.3}) {
    Motion run(
        text_of({.loads = pushes(), .solver = scaling(soft_step()) + Keys{{"damping", damping}}}));
    double largest = 0;
    run.go(
        [&] { largest = std::max(largest, std::abs(run.simulation.balance().relative_error())); });
    std::printf("damping %g: balance %.1e\n", damping, largest);
    EXPECT_LT(largest, 1e-6);
  }
}

TEST(MassScaling, LeavesStatesOfRestAsTheyAre) {
  const Stages loads = stage("loads.fixed", {{"on", "x_min"}}) +
                       stage("loads.gravity", {{"acceleration", {1000, 200, 0}}}) +
                       stage("loads.force", {{"on", "x_max"}, {"total", {-3, 0, 0}}});
  const auto rest = [&](const Keys& solver, double end) {
    Motion run(text_of(
        {.contrast = 10, .loads = loads, .solver = solver + Keys{{"damping", 0.7}}, .end = end}));
    EXPECT_GT(scaling_of(run).share(), 1);
    run.go();
    return displacements(run.simulation);
  };
  Json solved = Json::parse(text_of({.contrast = 10, .loads = loads}));
  solved["pipeline"].back() = {{"type", "solvers.static"}, {"tolerance", 1e-10}};
  Motion truth(solved.dump());
  truth.go();
  const std::vector<double> u = displacements(truth.simulation),
                            found = rest(scaling(soft_step()), 3e-2);
  std::printf("error at rest %.1e\n", distance(found, u) / largest(u));
  EXPECT_LT(distance(found, u), 1e-5 * largest(u));
}

TEST(MassScaling, GivesTheSameBitsOnAnyThreadsAndAfterANewStart) {
  const std::string text =
      text_of({.loads = pushes(),
               .solver = scaling(soft_step()) + Keys{{"damping", 0.1}},
               .more = stage("solvers.explicit", Keys{{"end_time", 8e-5}} + scaling(3e-7))});
  std::vector<char> half, changed;  // within the first stage, and at its end
  const auto run_on = [&](int threads) {
    Motion run(text, threads);
    const std::uint64_t steps = run.plan->stages.front().plan.steps;
    run.go([&] {
      if (threads != 2) return;
      if (run.simulation.steps() == steps / 2) half = saved(run.simulation);
      if (run.simulation.steps() == steps) changed = saved(run.simulation);
    });
    EXPECT_LT(std::abs(run.simulation.balance().relative_error()), 1e-6);
    return std::pair{run.simulation.hash(), run.simulation.balance().error};
  };
  const auto [one, error] = run_on(1);
  for (const int threads : {2, 3}) {
    const auto [hash, other] = run_on(threads);
    EXPECT_EQ(hash, one);
    EXPECT_EQ(other, error);
  }
  for (const bool within : {true, false}) {
    Motion run(text, 2);
    EXPECT_EQ(restore(run.simulation, within ? half : changed), (within ? half : changed).size());
    for (std::size_t n = within ? 0 : 1; n < 2; ++n)
      StageCalls(run.model(), run.simulation, run.plan->stages[n], 2, {},
                 n == 0 ? run.simulation.steps() : 0)
          .run();
    EXPECT_EQ(run.simulation.hash(), one) << within;
    EXPECT_EQ(run.simulation.balance().error, error) << within;
  }
}

TEST(MassScaling, ChangesNothingWhereNoParticleNeedsMass) {
  const auto hash = [](const Keys& solver) {
    Motion run(text_of({.contrast = 100, .loads = pushes(), .solver = solver}));
    run.go();
    return run.simulation.hash();
  };
  EXPECT_EQ(hash(scaling(1e-9)), hash({}));
}

TEST(MassScaling, ComesAndGoesBetweenStages) {
  // The balance closes, and the body moves on as if nothing had happened.
  const auto stages = [](const Keys& first, const Keys& second, const Keys& third) {
    return text_of({.contrast = 4,
                    .loads = pushes(),
                    .solver = first,
                    .end = 3e-5,
                    .more = stage("solvers.explicit", Keys{{"end_time", 6e-5}} + second) +
                            stage("solvers.explicit", Keys{{"end_time", 9e-5}} + third)});
  };
  Motion truth(stages({}, {}, {})), run(stages({}, scaling(soft_step()), {}));
  truth.go();
  double largest_error = 0;
  run.go([&] {
    largest_error = std::max(largest_error, std::abs(run.simulation.balance().relative_error()));
  });
  const std::vector<double> u = displacements(truth.simulation);
  const double error = distance(displacements(run.simulation), u) / largest(u);
  std::printf("balance %.1e, error %.1e\n", largest_error, error);
  EXPECT_LT(largest_error, 1e-6);
  EXPECT_LT(error, 0.1);
}

TEST(MassScaling, InFloats) {
  const auto end = [](const Keys& scene) {
    Motion run(text_of({.loads = pushes(), .solver = scaling(soft_step()), .scene = scene}));
    run.go();
    return displacements(run.simulation);
  };
  const std::vector<double> doubles = end({}), floats = end({{"precision", "float"}});
  EXPECT_LT(distance(doubles, floats), 1e-3 * largest(doubles));
  EXPECT_GT(distance(doubles, floats), 0);
}

TEST(MassScaling, RefusesWhatItCannotDo) {
  const auto fault = [](const Bar& bar, const std::string& solver = "solvers.explicit") {
    Json scene = Json::parse(text_of(bar));
    scene["pipeline"].back()["type"] = solver;
    try {
      plan_of(scene.dump());
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const Keys scaled = scaling(1e-6);
  EXPECT_NE(fault({.solver = scaled + Keys{{"local_steps", 4}}}).find("local_steps 1"),
            std::string::npos);
  EXPECT_NE(fault({.solver = scaled}, "solvers.implicit").find("mass_scaling"), std::string::npos);
  EXPECT_NE(fault({.solver = scaled, .soft = {{"poisson", 0.4}}}).find("volumetric"),
            std::string::npos);
  EXPECT_NE(fault({.solver = scaled, .soft = {{"membrane", "I"}, {"poisson", 0.1}}})
                .find("holds its heights"),
            std::string::npos);
  EXPECT_EQ(fault({.solver = scaled}), "");
}

}  // namespace mass_scaling_test
