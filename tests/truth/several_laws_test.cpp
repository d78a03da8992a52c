// Laws of each kind, alone and beside others in one body, against closed forms. Chains of particles
// have exact ones: n springs in a line under a force F are longer by the sum of e(F).
#include <support/laws.hpp>
#include <support/rest.hpp>

#include <gtest/gtest.h>

#include <array>

namespace several_laws_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr double spacing = 1e-3, young = 1e10;
/// k of the base springs in a cubic lattice without a membrane, N/m.
constexpr double stiffness = 0.4 * young * spacing;
constexpr int particles = 12;

const Keys stiff_law = {{"strain", 0.01}}, plastic_law = {{"yield", 2e6}, {"hardening", 0.1}},
           softening_law = {{"strength", 3e6}, {"fracture_energy", 5}};

Stages material(const std::string& law, const Keys& more = {}) {
  return stage("materials." + law,
               Keys{{"young", 1e10}, {"density", 2500}, {"membrane", "none"}} + more);
}
/// The key that gives a material to the part of the body above a corner.
Keys beyond(Vec3 low) { return {{"region", box(low, {1, 1, 1})}}; }
/// The key that gives a material to the particles of a chain from number `first` on.
Keys from(int first) { return beyond({-1, -1, first * spacing}); }

Stages statics(double tolerance, const Keys& more = {}) {
  return stage("solvers.static", Keys{{"tolerance", tolerance}} + more);
}

SceneBuilder with_test_laws() {
  return SceneBuilder{}.key("plugins", {HYPERLATTICE_BUILD "/tests/test_laws"});
}

/// A chain along z, held at its first particle, with a force on its last.
SceneBuilder chain(const Stages& materials, const Stages& loads,
                   const Stages& solvers = statics(1e-11)) {
  return with_test_laws()
      .lattice("lattices.cubic", spacing, box({}, {spacing, spacing, particles * spacing}))
      .stages(materials)
      .load("loads.fixed", {{"on", "all"}, {"axes", "xy"}, {"name", "guide"}})
      .load("loads.fixed", {{"on", "z_min"}, {"axes", "z"}})
      .stages(loads)
      .stages(solvers);
}
Stages pull(double force) {
  return stage("loads.force", {{"on", "z_max"}, {"total", Vec3{0, 0, force}}});
}
AtRest rest_of(const SceneBuilder& scene) { return AtRest(scene.text()); }
double end_of(const AtRest& body) { return body.u[3 * (particles - 1) + 2]; }

/// Solves f(e) = F for e in [0, most] by bisection.
template <class Force>
double elongation_at(double force, double most, const Force& of) {
  double low = 0, high = most;
  for (int n = 0; n < 200; ++n) ((of((low + high) / 2) < force) ? low : high) = (low + high) / 2;
  return (low + high) / 2;
}

double stiffening(double e) {
  const double ratio = e / (0.01 * spacing);
  return stiffness * e * (1 + ratio * ratio);
}

TEST(SeveralLaws, ALawWithConstantsAndATangentIsSolvedExactly) {
  for (const double force : {1.0, 40.0, 400.0}) {
    const AtRest body = rest_of(chain(material("stiffening", stiff_law), pull(force)));
    const double expected = (particles - 1) * elongation_at(force, spacing, stiffening);
    EXPECT_NEAR(end_of(body) / expected, 1, 1e-9) << force;
  }
}

TEST(SeveralLaws, ALawWithConstantsHasOneForceInAllKernels) {
  // Eight cells a side: rows longer than a vector. The other way goes neighbour by neighbour.
  const auto plan = plan_of(with_test_laws()
                                .lattice("lattices.cubic", 1e-3, box_mm(8, 8, 8))
                                .stages(material("stiffening", stiff_law))
                                .solver("solvers.explicit", {{"end_time", 1}})
                                .text());
  const Ended fast = shaken(*plan, 0.4, 200, 1), three = shaken(*plan, 0.4, 200, 3);
  EXPECT_EQ(fast.hash, three.hash);
  EXPECT_LT(std::abs(fast.balance.relative_error()), 1e-3);
  EXPECT_GT(fast.balance.stored, 0);
  EXPECT_EQ(fast.balance.dissipated(), 0);
}

// The limit of a chain's spring is k e of the spring along a bar in [100] under the stress `yield`:
// k L yield / E.
TEST(SeveralLaws, APlasticBarIsPulledAlongTheBilinearCurve) {
  const double limit = stiffness * spacing * 2e6 / young;
  for (const double over : {0.5, 0.99, 1.5, 3.0}) {
    const AtRest body = rest_of(chain(material("plastic", plastic_law), pull(over * limit),
                                      statics(1e-9, {{"load_steps", 100}})));
    const double first = limit / stiffness,
                 e = over <= 1 ? over * first : first + (over - 1) * limit / (0.1 * stiffness);
    EXPECT_NEAR(end_of(body) / ((particles - 1) * e), 1, 1e-8) << over;
    // Each spring dissipates the area between the curve and the elastic unloading. The step in
    // which it begins to yield is booked by the trapezoidal rule.
    const double flowed =
                     over <= 1 ? 0 : (over - 1) * limit * (1 / (0.1 * stiffness) - 1 / stiffness),
                 lost = (particles - 1) * 0.5 * (1 + over) * limit * flowed;
    EXPECT_NEAR(body.simulation->balance().dissipated_damping, lost, 0.01 * lost + 1e-18) << over;
    EXPECT_LT(std::abs(body.simulation->balance().relative_error()), 1e-6);
  }
}

// A stage to the peak and a stage back to no load: the memory is kept between states of rest.
TEST(SeveralLaws, APlasticBarKeepsItsSetWhenUnloaded) {
  const double limit = stiffness * spacing * 2e6 / young;
  const auto plan =
      plan_of(chain(material("plastic", plastic_law),
                    stage("loads.expression", {{"on", "z_max"},
                                               {"expression", "min(t, 2 - t)"},
                                               {"corners", {0, 1, 2}},
                                               {"total", Vec3{0, 0, 2 * limit}}}),
                    statics(1e-8, {{"end_time", 1}}) + stage("solvers.static", {{"end_time", 2}}))
                  .text());
  Simulation simulation(*plan->model, 1);
  for (const PlannedStage& stage : plan->stages)
    StageCalls(*plan->model, simulation, stage, 1, {}).run();
  const double set = limit * (1 / (0.1 * stiffness) - 1 / stiffness);
  EXPECT_NEAR(displacements(simulation)[3 * (particles - 1) + 2] / ((particles - 1) * set), 1,
              1e-8);
  EXPECT_NEAR(simulation.balance().stored, 0, 1e-9 * limit * set);
}

// n springs of A, one of two halves, m springs of B.
TEST(SeveralLaws, ABarOfTwoLawsIsASeriesOfSprings) {
  const double limit = stiffness * spacing * 2e6 / young;
  for (const double over : {0.5, 1.5, 2.5}) {
    const AtRest body = rest_of(
        chain(material("stiffening", stiff_law) + material("plastic", plastic_law + from(5)),
              pull(over * limit)));
    const double a = elongation_at(over * limit, spacing, stiffening),
                 b = elongation_at(over * limit, spacing, [&](double e) {
                   return e <= limit / stiffness
                              ? stiffness * e
                              : limit + 0.1 * stiffness * (e - limit / stiffness);
                 });
    EXPECT_NEAR(end_of(body) / (4.5 * a + 6.5 * b), 1, 1e-8) << over;
    EXPECT_LT(std::abs(body.simulation->balance().relative_error()), 1e-2) << over;
  }
}

TEST(SeveralLaws, TheSceneMayChooseTheSofterOrTheStifferSpring) {
  const double limit = stiffness * spacing * 2e6 / young, force = 1.5 * limit;
  const auto end_with = [&](const std::string& rule) {
    return end_of(rest_of(
        chain(material("elastic", {{"young", 3e10}}) + material("plastic", plastic_law + from(5)),
              pull(force))
            .key("interface_springs", rule)));
  };
  const double a = force / (3 * stiffness), b = (limit + 0.5 * limit / 0.1) / stiffness;
  EXPECT_NEAR(end_with("series") / (4.5 * a + 6.5 * b), 1, 1e-8);
  EXPECT_NEAR(end_with("softer") / (4 * a + 7 * b), 1, 1e-8);
  EXPECT_NEAR(end_with("stiffer") / (5 * a + 6 * b), 1, 1e-8);
}

// Three particles in a line, elastic, viscous, elastic; the first is held, the last is struck. Each
// spring has an elastic and a Kelvin-Voigt half of the elongation w,
//   f = 2 k (u - w) = 2 k (w + tau dw/dt).
// Truth: this system of ordinary differential equations by the Runge-Kutta method.
TEST(SeveralLaws, AViscousJointBetweenElasticBlocksFollowsItsDifferentialEquations) {
  constexpr double mass = 2500e-9, tau = 2e-5, speed = 0.1;
  const auto plan = plan_of(
      SceneBuilder{}
          .lattice("lattices.cubic", spacing, box({}, {spacing, spacing, 3 * spacing}))
          .stages(material("elastic") + material("viscous", Keys{{"time", "20 us"}} + from(1)) +
                  material("elastic", from(2)))
          .load("loads.fixed", {{"on", "z_min"}})
          .solver("solvers.explicit", {{"end_time", 1}})
          .text());
  Simulation simulation(*plan->model, 1);
  simulation.set_velocities({0, 0, 0, 0, 0, 0, 0, 0, speed}, {});
  using State = std::array<double, 6>;  // places and speeds of two particles, two halves
  const auto rate = [&](const State& s) {
    const double first = 2 * stiffness * (s[0] - s[4]),
                 second = 2 * stiffness * (s[1] - s[0] - s[5]);
    return State{s[2],
                 s[3],
                 (second - first) / mass,
                 -second / mass,
                 (s[0] - 2 * s[4]) / tau,
                 (s[1] - s[0] - 2 * s[5]) / tau};
  };
  const auto moved = [](State s, double by, const State& along) {
    for (std::size_t n = 0; n < s.size(); ++n) s[n] += by * along[n];
    return s;
  };
  State truth{0, 0, 0, speed, 0, 0};
  const double step = 1e-8;
  double worst = 0, largest = 0;
  for (int n = 1; n <= 20000; ++n) {
    simulation.step(step);
    const State k1 = rate(truth), k2 = rate(moved(truth, step / 2, k1)),
                k3 = rate(moved(truth, step / 2, k2)), k4 = rate(moved(truth, step, k3));
    for (std::size_t c = 0; c < truth.size(); ++c)
      truth[c] += step / 6 * (k1[c] + 2 * k2[c] + 2 * k3[c] + k4[c]);
    const std::vector<double> u = displacements(simulation);
    worst = std::max({worst, std::abs(u[5] - truth[0]), std::abs(u[8] - truth[1])});
    largest = std::max(largest, std::abs(truth[1]));
  }
  EXPECT_LT(worst, 0.003 * largest);
  EXPECT_LT(std::abs(simulation.balance().relative_error()), 1e-4);
  EXPECT_GT(simulation.balance().dissipated_damping, 0.5 * 0.5 * mass * speed * speed);
}

// At rest a viscous spring is elastic: a beam of an elastic and a viscous layer bends as one of two
// elastic layers, and as the theory of composite beams says.
TEST(SeveralLaws, ABeamOfTwoLayersBendsAsItsTransformedSection) {
  const auto deflection = [](const std::string& upper, const Keys& more = {}) {
    const AtRest beam =
        rest_of(SceneBuilder{}
                    .lattice("lattices.cubic", 1e-3, box_mm(60, 4, 6), {{"boundary", "cells"}})
                    .stages(material("elastic"))
                    .stages(material(upper, Keys{{"young", 4e10}} + beyond({-1, -1, 3e-3}) + more))
                    .load("loads.fixed", {{"on", "x_min"}})
                    .load("loads.force", {{"on", "x_max"}, {"total", {0, 0, 1e-3}}})
                    .stages(to_rest));
    return beam.mean(2, [](Site s) { return s.i == 60; });
  };
  const double both_elastic = deflection("elastic"),
               two_laws = deflection("viscous", {{"time", "1 us"}});
  EXPECT_NEAR(two_laws / both_elastic, 1, 1e-6);
  // Layers of 3 mm, 10 and 40 GPa: the neutral axis is at (1.5 + 4 * 4.5) / 5 = 3.9 mm.
  const double b = 4e-3, h = 3e-3, third = b * h * h * h / 12,
               rigidity = 1e10 * (third + b * h * 2.4e-3 * 2.4e-3) +
                          4e10 * (third + b * h * 0.6e-3 * 0.6e-3),
               expected = 1e-3 * 60e-3 * 60e-3 * 60e-3 / (3 * rigidity);
  EXPECT_NEAR(two_laws / expected, 1, 0.05);
}

/// A block of three materials with three laws; the rows are several vectors long.
std::string block_of_three(const std::string& boundary, const std::string& lattice) {
  return SceneBuilder{}
      .lattice(lattice, 1e-3, box_mm(20, 6, 8), {{"boundary", boundary}})
      .stages(material("elastic") + material("plastic", plastic_law + beyond({7e-3, -1, -1})) +
              material("softening", softening_law + beyond({12e-3, -1, 3e-3})))
      .solver("solvers.explicit", {{"end_time", 1}})
      .text();
}

class BlockOfThreeLaws : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(BlockOfThreeLaws, KeepsItsEnergyAndHasTheSameBitsForAnyThreads) {
  const auto plan = plan_of(block_of_three(GetParam().first, GetParam().second));
  const Ended one = shaken(*plan, 0.3, 300, 1, 2), two = shaken(*plan, 0.3, 300, 2, 2),
              four = shaken(*plan, 0.3, 300, 4, 2);
  EXPECT_EQ(one.hash, two.hash);
  EXPECT_EQ(one.hash, four.hash);
  EXPECT_GT(one.balance.dissipated_damping, 0);
  EXPECT_GT(one.balance.dissipated_failure, 0);
  EXPECT_LT(std::abs(one.balance.relative_error()), 1e-4);
  EXPECT_NEAR(one.balance.error, two.balance.error, 1e-9 * one.balance.scale);
}
INSTANTIATE_TEST_SUITE_P(Lattices, BlockOfThreeLaws,
                         testing::Values(std::pair{"particles", "lattices.cubic"},
                                         std::pair{"cells", "lattices.cubic"},
                                         std::pair{"particles", "lattices.fcc"}));

TEST(SeveralLaws, AListOfThreeLawsKeepsItsEnergy) {
  const auto plan =
      plan_of(SceneBuilder{}
                  .lattice("lattices.random", 1e-3, box_mm(12, 5, 5))
                  .stages(material("elastic") +
                          material("viscous", Keys{{"time", 2e-8}} + beyond({4e-3, -1, -1})) +
                          material("softening", softening_law + beyond({8e-3, -1, -1})))
                  .solver("solvers.explicit", {{"end_time", 1}})
                  .text());
  const Ended one = shaken(*plan, 0.2, 300, 1, 2), three = shaken(*plan, 0.2, 300, 3, 2);
  EXPECT_EQ(one.hash, three.hash);
  EXPECT_LT(std::abs(one.balance.relative_error()), 1e-5);
  EXPECT_GT(one.balance.dissipated_damping, 0);
  EXPECT_GT(one.balance.dissipated_failure, 0);
}

// Two particles, the lower one softer by a factor of four and with a limit of strain: their spring
// breaks under the force that breaks a spring of the softer material, k_a limit L, at the
// elongation k_a / k limit L with k = 2 k_a k_b / (k_a + k_b).
TEST(SeveralLaws, EachHalfOfASpringHasItsOwnStrength) {
  constexpr double limit = 1e-3, joined = 2 * 4.0 / (1 + 4.0);
  const auto broken_at = [&](const Stages& upper, const std::string& rule, double strain) {
    const Json criterion = {{"type", "failures.strain"}, {"limit", limit}};
    const auto plan =
        plan_of(SceneBuilder{}
                    .key("interface_springs", rule)
                    .lattice("lattices.cubic", spacing, box({}, {spacing, spacing, 2 * spacing}))
                    .stages(material("elastic", {{"failure", criterion}}))
                    .stages(upper)
                    .solver("solvers.explicit", {{"end_time", 1}})
                    .text());
    Simulation simulation(*plan->model, 1);
    simulation.set_displacements({0, 0, 0, 0, 0, strain * spacing}, {});
    simulation.step(1e-12);
    return simulation.breakages().size();
  };
  const Keys stiff = Keys{{"young", 4e10}} + from(1);
  for (const Stages& upper :
       {material("elastic", stiff), material("viscous", Keys{{"time", "1 ps"}} + stiff)}) {
    const double strain = limit / joined;
    EXPECT_EQ(broken_at(upper, "series", 0.999 * strain), 0u);
    EXPECT_EQ(broken_at(upper, "series", 1.001 * strain), 1u);
    EXPECT_EQ(broken_at(upper, "softer", 0.999 * limit), 0u);
    EXPECT_EQ(broken_at(upper, "softer", 1.001 * limit), 1u);
    EXPECT_EQ(broken_at(upper, "stiffer", 0.5), 0u);
  }
}

// Two materials that are equal in all but their name of law: the body must move as one of one law.
TEST(SeveralLaws, HalvesOfTheSameElasticityAreAsOneSpring) {
  const auto moved = [](const Stages& materials) {
    const auto plan = plan_of(SceneBuilder{}
                                  .lattice("lattices.cubic", 1e-3, box_mm(12, 5, 5))
                                  .stages(materials)
                                  .solver("solvers.explicit", {{"end_time", 1}})
                                  .text());
    Simulation simulation(*plan->model, 1);
    simulation.set_velocities(
        noise(3 * plan->model->body.particles, 1, 3),
        std::vector<double>(plan->model->degrees_of_freedom == 4 ? plan->model->body.particles : 0,
                            0.0));
    for (int n = 0; n < 100; ++n) simulation.step(5e-8);
    return displacements(simulation);
  };
  for (const Keys& membrane :
       {Keys{{"membrane", "none"}}, Keys{{"membrane", "I-m"}, {"poisson", 0.1}},
        Keys{{"membrane", "III"}, {"poisson", 0.1}}}) {
    const Keys relaxing = Keys{{"time", 1e9}, {"share", 0.5}} + beyond({5e-3, -1, -1});
    const std::vector<double> one = moved(material("elastic", membrane)),
                              two = moved(material("elastic", membrane) +
                                          material("relaxing", membrane + relaxing));
    double largest = 0, apart = 0;
    for (std::size_t n = 0; n < one.size(); ++n) {
      largest = std::max(largest, std::abs(one[n]));
      apart = std::max(apart, std::abs(one[n] - two[n]));
    }
    EXPECT_LT(apart, 1e-9 * largest) << membrane.json();
  }
}

}  // namespace several_laws_test
