// Springs that soften: what they lose is energy of fracture, and what they lack is damage.
#include <support/laws.hpp>
#include <support/rest.hpp>

#include <gtest/gtest.h>

namespace softening_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr double spacing = 1e-3, stiffness = 0.4 * 1e10 * spacing;

/// Two particles joined by one spring; the upper one is moved by a static solver.
std::string pair_of(double displacement) {
  return SceneBuilder{}
      .lattice("lattices.cubic", spacing, box({}, {spacing, spacing, 2 * spacing}))
      .material("materials.softening", {{"young", 1e10},
                                        {"density", 2500},
                                        {"membrane", "none"},
                                        {"strength", 3e6},
                                        {"fracture_energy", 5}})
      .load("loads.fixed", {{"on", "z_min"}})
      .load("loads.displacement",
            {{"on", "z_max"}, {"rise", "1 us"}, {"value", Vec3{0, 0, displacement}}})
      .solver("solvers.static", {{"load_steps", 400}})
      .text();
}

struct Strains {
  double strength, opening;
};
Strains strains_of(const Model& model) {
  const double* constants = model.springs.spring(0, 0, 0).law[0];
  return {constants[0], constants[1]};
}

TEST(Softening, LosesTheAreaUnderItsCurveAsEnergyOfFracture) {
  const Strains limits = strains_of(*plan_of(pair_of(1e-9))->model);
  const double first = limits.strength * spacing, last = limits.opening * spacing,
               whole = 0.5 * stiffness * first * last;
  const AtRest gone(pair_of(1.1 * last));
  const EnergyBalance balance = gone.simulation->balance();
  EXPECT_NEAR(balance.dissipated_failure / whole, 1, 2e-3);
  EXPECT_EQ(balance.dissipated_damping, 0);
  EXPECT_NEAR(balance.stored, 0, 1e-12 * whole);
  EXPECT_LT(std::abs(balance.relative_error()), 1e-9);
  ASSERT_EQ(gone.simulation->breakages().size(), 1u);
  EXPECT_TRUE(gone.simulation->breakages().front().softened);

  // Half-way: the triangle between the peak and the secant back to the origin.
  const double middle = 0.5 * (first + last);
  const AtRest half(pair_of(middle));
  const double left = 0.5 * stiffness * first;  // half of the largest force
  EXPECT_NEAR(half.simulation->balance().stored, 0.5 * left * middle, 1e-9 * whole);
  EXPECT_NEAR(half.simulation->balance().dissipated_failure,
              0.5 * stiffness * first * first + 0.75 * stiffness * first * (middle - first) -
                  0.5 * left * middle,
              2e-3 * whole);
  EXPECT_TRUE(half.simulation->breakages().empty());
}

TEST(Softening, DamageIsWhatTheIntegrityOfSpringsLacks) {
  const Strains limits = strains_of(*plan_of(pair_of(1e-9))->model);
  for (const double strain :
       {0.9 * limits.strength, 0.5 * (limits.strength + limits.opening), 1.1 * limits.opening}) {
    const AtRest body(pair_of(strain * spacing));
    const double integrity = strain <= limits.strength ? 1
                             : strain >= limits.opening
                                 ? 0
                                 : limits.strength * (limits.opening - strain) /
                                       (strain * (limits.opening - limits.strength));
    const std::vector<WeakenedSpring> weakened = body.simulation->weakened_springs();
    double lost = 0;
    for (const WeakenedSpring& spring : weakened) lost += 1 - spring.integrity;
    EXPECT_LE(weakened.size(), 1U);
    EXPECT_NEAR(lost, 1 - integrity, 1e-9) << strain;
  }
}

// A spring that softens and is removed later by a criterion has two entries and counts once.
TEST(Softening, ASpringThatIsRemovedAfterItSoftenedCountsOnce) {
  const auto plan =
      plan_of(SceneBuilder{}
                  .lattice("lattices.cubic", spacing, box({}, {spacing, spacing, 2 * spacing}))
                  .material("materials.softening",
                            {{"young", 1e10},
                             {"density", 2500},
                             {"membrane", "none"},
                             {"strength", 3e6},
                             {"fracture_energy", 5},
                             {"failure", {{"type", "failures.strain"}, {"limit", 0.2}}}})
                  .solver("solvers.explicit", {{"end_time", 1}})
                  .text());
  Simulation simulation(*plan->model, 1);
  simulation.set_velocities({0, 0, 0, 0, 0, 5}, {});
  while (simulation.time() < 60e-6) simulation.step(1e-7);
  std::vector<bool> softened;
  for (const Breakage& breakage : simulation.breakages()) softened.push_back(breakage.softened);
  EXPECT_EQ(softened, (std::vector<bool>{true, false}));
  EXPECT_EQ(simulation.broken(), 1u);
  EXPECT_EQ(simulation.broken_open(), 1u);
}

// In steps in time the energy that a block of one law loses is energy of fracture too, with the
// same bits for any number of threads.
TEST(Softening, ABlockThatIsTornLosesEnergyOfFractureOnly) {
  const auto plan =
      plan_of(law_scene(stage("lattices.cubic", {{"spacing", 1e-3}, {"shape", box_mm(5, 4, 6)}}),
                        {{"type", "materials.softening"},
                         {"strength", 3e6},
                         {"fracture_energy", 5},
                         {"membrane", "I-m"},
                         {"poisson", 0.1}}));
  const Ended one = shaken(*plan, 0.4, 300, 1), three = shaken(*plan, 0.4, 300, 3);
  EXPECT_GT(one.balance.dissipated_failure, 0.1 * one.balance.scale);
  EXPECT_EQ(one.balance.dissipated_damping, 0);
  EXPECT_EQ(one.balance.dissipated_failure, three.balance.dissipated_failure);
  EXPECT_EQ(one.hash, three.hash);
}

}  // namespace softening_test
