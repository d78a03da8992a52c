// Strength surfaces against their closed forms, and the constants of the damage of a material:
// lengths, energies, alarms, scatter, particles near supports, refusals.
#include <plan/damage.hpp>
#include <support/models.hpp>
#include <support/scenes.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strength_surface_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

using std::numbers::pi;
constexpr double strength = 1e6, energy = 6000, spacing = 1, modulus = 1.2e9;  // C11 for E 1 GPa

/// A surface with these keys besides strength and fracture energy.
Json surface_stage(const std::string& type, const Keys& more = {}) {
  return (Keys{{"type", type}, {"strength", strength}, {"fracture_energy", energy}} + more).json();
}
/// The failure of a material.
Keys surface(const std::string& type, const Keys& more = {}) {
  return {{"failure", surface_stage(type, more)}};
}
BuiltScene cube(const Keys& failure, const Keys& material = {{"poisson", 0.25}}) {
  return build(box_lattice(6, 6, 6) + elastic(material + failure));
}
const Cohesive& cohesive(const BuiltScene& built) { return built->cohesive.at(0); }
std::string refusal(const Keys& failure, const Keys& material = {{"poisson", 0.25}}) {
  return faults_of(box_lattice(6, 6, 6) + elastic(material + failure));
}
/// The ratio of a stress in units of the strength.
double ratio(const BuiltScene& built, double first, double second, double third) {
  const PrincipalStress stress{strength * first, strength * second, strength * third};
  double found = 0;
  cohesive(built).ratios({&stress, 1}, &found);
  return found;
}

void expect_in(const std::string& message, std::initializer_list<const char*> parts) {
  for (const char* part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
}

TEST(StrengthSurface, RankineKnowsTheLargestStressOnly) {
  const BuiltScene built = cube(surface("failures.cohesive"));
  EXPECT_DOUBLE_EQ(ratio(built, 0.5, 0.2, -30), 0.5);
  EXPECT_DOUBLE_EQ(ratio(built, 2, 2, 2), 2);
  EXPECT_EQ(ratio(built, 0, -1, -50), 0);
  EXPECT_EQ(ratio(built, -1, -1, -50), 0);
}

TEST(StrengthSurface, MohrCoulombHasItsStrengthInCompressionAndItsFriction) {
  // N = 3 for 30 degrees.
  const BuiltScene built =
      cube(surface("failures.cohesive",
                   {{"compressive_strength", 10 * strength}, {"friction_angle", "30 degrees"}}));
  EXPECT_NEAR(ratio(built, 1, 0, 0), 1, 1e-12);
  EXPECT_NEAR(ratio(built, 0, 0, -10), 1, 1e-12);
  EXPECT_NEAR(ratio(built, -2, -2, -16), 1, 1e-12);  // confined: s3 = -C + N s1
  EXPECT_NEAR(ratio(built, 0.5, 0, -8.5), 1, 1e-12);
  EXPECT_EQ(ratio(built, -20, -20, -20), 0);
  // The simple form without an angle: N = C / sigma_t.
  const BuiltScene simple =
      cube(surface("failures.cohesive", {{"compressive_strength", 10 * strength}}));
  EXPECT_NEAR(ratio(simple, 0.4, 0, -3), 0.7, 1e-12);
  EXPECT_NEAR(ratio(simple, 1, 0, 0), 1, 1e-12);
}

TEST(StrengthSurface, FrictionThatBreaksBelowTheStrengthIsRefused) {
  expect_in(refusal(surface("failures.cohesive", {{"compressive_strength", 2 * strength},
                                                  {"friction_angle", "30 degrees"}})),
            {"/failure/friction_angle", "compressive_strength / strength"});
  expect_in(refusal(surface("failures.cohesive", {{"friction_angle", "30 degrees"}})),
            {"/failure/friction_angle", "a compressive_strength beside it"});
  expect_in(refusal(surface("failures.cohesive", {{"compressive_strength", 0.5 * strength}})),
            {"/failure/compressive_strength", "at least the strength in tension"});
}

TEST(StrengthSurface, VonMisesDoesNotKnowThePressure) {
  const BuiltScene built = cube(surface("failures.von_mises"));
  EXPECT_NEAR(ratio(built, 1, 0, 0), 1, 1e-12);
  EXPECT_NEAR(ratio(built, 0, 0, -1), 1, 1e-12);
  EXPECT_NEAR(ratio(built, 1, 0, -1), std::sqrt(3), 1e-12);
  EXPECT_NEAR(ratio(built, 8, 7, 7), 1, 1e-12);
}

/// Strengths of the glass of the "nine circles" over that in tension, 40 MPa: compression, shear,
/// biaxial tension, tension from all sides.
constexpr double glass_compression = 1000 / 40.0, glass_shear = 44.4 / 40,
                 glass_biaxial = 27 / 40.0, glass_hydrostatic = 27.8 / 40;

TEST(StrengthSurface, DruckerPragerMeetsTheNineCirclesOfGlass) {
  const BuiltScene built = cube(
      surface("failures.drucker_prager", {{"compressive_strength", glass_compression * strength}}));
  EXPECT_NEAR(ratio(built, 1, 0, 0), 1, 1e-12);
  EXPECT_NEAR(ratio(built, 0, 0, -glass_compression), 1, 1e-12);
  constexpr double digits = 2e-3;  // the strengths are given to two or three digits
  EXPECT_NEAR(ratio(built, glass_shear, 0, -glass_shear), 1, digits);
  EXPECT_NEAR(ratio(built, glass_biaxial, glass_biaxial, 0), 1, digits);
  EXPECT_NEAR(ratio(built, glass_hydrostatic, glass_hydrostatic, glass_hydrostatic), 1, digits);
  EXPECT_EQ(ratio(built, -1, -1, -1), 0);
}

Keys multiaxial(double compression, double shear, double biaxial) {
  return surface("failures.multiaxial", {{"compressive_strength", compression * strength},
                                         {"shear_strength", shear * strength},
                                         {"biaxial_strength", biaxial * strength}});
}

TEST(StrengthSurface, MultiaxialGoesThroughFourStrengths) {
  const BuiltScene built = cube(multiaxial(10, 0.975, 0.8));
  EXPECT_NEAR(ratio(built, 1, 0, 0), 1, 1e-12);
  EXPECT_NEAR(ratio(built, 0, 0, -10), 1, 1e-12);
  EXPECT_NEAR(ratio(built, 0.975, 0, -0.975), 1, 1e-12);
  EXPECT_NEAR(ratio(built, 0.8, 0.8, 0), 1, 1e-12);
}

TEST(StrengthSurface, MultiaxialTakesTheNearestConvexSurface) {
  const BuiltScene built = cube(multiaxial(glass_compression, glass_shear, glass_biaxial));
  EXPECT_NEAR(ratio(built, 1, 0, 0), 1, 1e-12);
  EXPECT_NEAR(ratio(built, 0, 0, -glass_compression), 1, 1e-12);
  EXPECT_NEAR(ratio(built, glass_shear, 0, -glass_shear), 1, 1e-3);
  EXPECT_NEAR(ratio(built, glass_biaxial, glass_biaxial, 0), 1, 1e-3);
  EXPECT_NEAR(ratio(built, glass_hydrostatic, glass_hydrostatic, glass_hydrostatic), 1, 5e-3);
  expect_in(refusal(multiaxial(glass_compression, 2, glass_biaxial)),
            {"/failure/shear_strength", "about ", "nearest convex"});
}

TEST(Cohesive, ConstantsFollowFromTheInputs) {
  const BuiltScene built = cube(surface("failures.cohesive"));
  const Cohesive& of = cohesive(built);
  const double length = 8 * modulus * energy / (3 * pi * strength * strength) - 0.175 * spacing;
  EXPECT_NEAR(of.modulus, modulus, 1e-6 * modulus);
  EXPECT_NEAR(of.bulk_modulus, 1e9 / 1.5, 1e3);
  EXPECT_NEAR(of.length, length, 1e-6 * length);
  EXPECT_NEAR(of.corrected, energy / (1 + 0.175 * spacing / length), 1e-6 * energy);
  EXPECT_NEAR(of.shape(strength), 0.75, 1e-9);  // the largest length is that of A = 3/4
  EXPECT_NEAR(of.largest_admissible_strength(), strength, 1e-6 * strength);
  EXPECT_NEAR(of.wave_speed, std::sqrt(modulus / 1000), 1e-3);
  EXPECT_NEAR(of.viscosity, 0.5 * length / of.wave_speed, 1e-9);
  EXPECT_EQ(of.final_opening(), 2 * energy / strength);
  EXPECT_EQ(of.strength_of(17), strength);
}

TEST(Cohesive, ModulusHasTheMembraneInIt) {
  const BuiltScene built =
      cube(surface("failures.cohesive"), {{"membrane", "I-m"}, {"poisson", 0.1}});
  const double expected = 1e9 * 0.9 / (1.1 * 0.8);
  EXPECT_NEAR(cohesive(built).modulus, expected, 1e-6 * expected);
}

TEST(Cohesive, AlarmOfRankineIsTheStrengthUnderTensionFromAllSides) {
  const BuiltScene built = cube(surface("failures.cohesive"));
  const double strain = strength / (3 * cohesive(built).bulk_modulus);
  const double alarm = cohesive(built).stretch_alarm;
  EXPECT_LT(alarm, strain);
  EXPECT_GT(alarm, 0.85 * strain);
  EXPECT_FALSE(cohesive(built).crushes());
  EXPECT_TRUE(built->springs.breakable);
  for (const NeighbourGeometry& to : built->springs.neighbours)
    EXPECT_DOUBLE_EQ(built->springs.spring(0, 0, to.site.spring_class).alarm,
                     alarm * to.rest_length);
  EXPECT_TRUE(built->materials[0].failures.empty());
}

TEST(Cohesive, CriteriaStandBesideASurface) {
  const Json elongation = {{"type", "failures.elongation"}, {"limit", 1e-5}};
  const BuiltScene built =
      cube({{"failure", Json::array({elongation, surface_stage("failures.cohesive")})}});
  EXPECT_EQ(built->materials[0].failures.size(), 1U);
  EXPECT_EQ(built->springs.spring(0, 0, 0).alarm, 1e-5);
  EXPECT_NE(cohesive(built).stage, nullptr);
}

TEST(Cohesive, CompressionThatCrushesHasAnAlarm) {
  const BuiltScene built =
      cube(surface("failures.cohesive", {{"compressive_strength", 10 * strength}}));
  EXPECT_TRUE(cohesive(built).crushes());
  EXPECT_GT(cohesive(built).shortening_alarm, cohesive(built).stretch_alarm);
  EXPECT_LT(cohesive(built).shortening_alarm, 10 * strength / 1e9);
}

TEST(Cohesive, StrengthsScatterAboutTheirMean) {
  constexpr double weibull = 10;
  const BuiltScene built = build(
      box_lattice(20, 20, 20) +
      elastic(Keys{{"poisson", 0.25}} + surface("failures.cohesive", {{"weibull_modulus", weibull},
                                                                      {"allow_coarse", true}})));
  const Cohesive& of = cohesive(built);
  double sum = 0, least = infinity, largest = 0;
  int below = 0;  // the scale: 63 % of the particles are weaker
  const double scale = strength / std::tgamma(1 + 1 / weibull);
  for (Particle p = 0; p < built->body.particles; ++p) {
    const double own = of.strength_of(p);
    sum += own;
    least = std::min(least, own);
    largest = std::max(largest, own);
    below += own < scale ? 1 : 0;
  }
  const double count = static_cast<double>(built->body.particles);
  EXPECT_NEAR(sum / count, strength, 5e-3 * strength);
  EXPECT_NEAR(below / count, 1 - std::exp(-1), 0.02);
  EXPECT_EQ(of.least_strength, least);
  EXPECT_EQ(of.largest_strength, largest);
  EXPECT_NEAR(of.shape(largest), 0.75, 1e-9);
  EXPECT_EQ(of.fracture_energy, energy);
  const BuiltScene same = cube(surface("failures.cohesive", {{"weibull_modulus", weibull}}));
  EXPECT_EQ(cohesive(same).strength_of(5), of.strength_of(5));
}

TEST(Cohesive, LengthsThatDoNotFitAreRefused) {
  expect_in(refusal(surface("failures.cohesive", {{"strength", 2e6}})),
            {"/failure/strength", "at most 1.387e+06 Pa", "a spacing of at most",
             "a fracture_energy of at least", "is at most 1.353 m", "allow_coarse"});
  // Not even a short one; the three ways out lead to a length of three spacings.
  const std::string none = refusal(surface("failures.cohesive", {{"strength", 8e6}}));
  expect_in(none, {"/failure/strength", "at most 1.387e+06 Pa", "no length of damage fits"});
  EXPECT_EQ(none.find("at most 0 m"), std::string::npos) << none;
  expect_in(none, {"a fracture_energy of at least 1.995e+05 J/m2"});
  EXPECT_EQ(
      refusal(surface("failures.cohesive", {{"strength", 8e6}, {"fracture_energy", 1.9952e5}})),
      "");
  expect_in(refusal(surface("failures.cohesive", {{"length", 8}})),
            {"/failure/length", "8 m", "at most 5.937 m", "a strength of at most"});
  expect_in(refusal(surface("failures.cohesive", {{"length", 2}})),
            {"/failure/length", "2 m", "at least 3 spacings", "allow_coarse"});
  EXPECT_EQ(refusal(surface("failures.cohesive", {{"length", 2}, {"allow_coarse", true}})), "");
  EXPECT_EQ(refusal(surface("failures.cohesive", {{"length", 3}})), "");
}

TEST(Cohesive, BodiesThatDamageDoesNotKnowAreRefused) {
  const Keys failure = surface("failures.cohesive");
  expect_in(refusal(failure, {{"poisson", 0.1}, {"volumetric", true}}), {"K_v below zero"});
  expect_in(refusal(failure, {{"membrane", "III"}, {"poisson", 0.2}}), {"no membrane, or one"});
  expect_in(faults_of(stage("lattices.bcc", {{"spacing", 1}, {"shape", box({}, {6, 6, 6})}}) +
                      elastic(Keys{{"poisson", 0.25}} + failure)),
            {"the cubic lattice"});
  expect_in(faults_of(stage("lattices.random", {{"spacing", 1}, {"shape", box({}, {6, 6, 6})}}) +
                      elastic(failure)),
            {"a list of springs has no field of damage"});
  expect_in(refusal({{"failure", Json::array({surface_stage("failures.cohesive"),
                                              surface_stage("failures.von_mises")})}}),
            {"/failure/1", "one strength surface"});
}

// E' is 0.89 C11 at nu = 1/4 and 0.33 C11 at 0.45.
TEST(Cohesive, ThePlanWarnsIfTheSofteningZoneIsShorterThanItsLength) {
  const auto warns = [](double poisson, double length) {
    const auto plan = plan_of(
        block(12, 12, 12,
              Keys{{"poisson", poisson}} +
                  surface("failures.cohesive",
                          {{"strength", 4e6}, {"fracture_energy", 30}, {"length", length}})));
    return std::any_of(plan->model->warnings.begin(), plan->model->warnings.end(),
                       [](const std::string& warning) {
                         return warning.find("zone that softens") != std::string::npos;
                       });
  };
  EXPECT_FALSE(warns(0.25, 12e-3));
  EXPECT_FALSE(warns(0.45, 12e-3));
  EXPECT_TRUE(warns(0.45, 36e-3));
}

TEST(Cohesive, NoDamageNearSupports) {
  const Stages load =
      stage("loads.displacement", {{"on", "x_min"}, {"value", {1e-6, 0, 0}}, {"rise", 1e-3}});
  const auto bar = [&](const Keys& more) {
    return build(box_lattice(20, 3, 3) +
                 elastic(Keys{{"poisson", 0.25}} +
                         surface("failures.cohesive", Keys{{"length", 4}} + more)) +
                 load);
  };
  const BuiltScene built = bar({});
  ASSERT_EQ(built->intact.size(), built->body.particles);
  const double first = built->body.lowest.x;
  for (Particle p = 0; p < built->body.particles; ++p)
    EXPECT_EQ(built->intact[p] != 0, built->body.position(p).x - first < 2 * pi) << p;
  EXPECT_TRUE(bar({{"intact_near_supports", false}})->intact.empty());
  EXPECT_TRUE(cube(surface("failures.cohesive"))->intact.empty());
}

TEST(Cohesive, ThePlanTellsLengthsAndWarns) {
  const auto plan =
      plan_of(block(12, 12, 12,
                    Keys{{"poisson", 0.25}} +
                        surface("failures.cohesive",
                                {{"strength", 4e6}, {"fracture_energy", 10}, {"length", 4e-3}})));
  const nlohmann::json facts = plan_json(*plan);
  const nlohmann::json& of = facts.at("damage").at(0);
  EXPECT_NEAR(of.at("length").get<double>(), 4e-3, 1e-12);
  EXPECT_NEAR(of.at("spacings").get<double>(), 4, 1e-9);
  EXPECT_NEAR(of.at("final_opening").get<double>(), 5e-6, 1e-12);
  const double corrected = 10 / (1 + 0.175 / 4);
  EXPECT_NEAR(of.at("characteristic_length").get<double>(), 1.2e10 * corrected / 1.6e13, 1e-8);
  EXPECT_NEAR(of.at("largest_strength").get<double>(),
              std::sqrt(8 * 1.2e10 * corrected / (3 * pi * 4e-3)), 100);
  std::string all;
  for (const nlohmann::json& warning : facts.at("warnings"))
    all += warning.get<std::string>() + "\n";
  expect_in(all, {"4 spacings", "quarter of the body"});
  expect_in(plan_text(*plan), {"length of damage", "crack without traction"});
}

TEST(Cohesive, SupportsThatKeepTheBodyIntactAreTold) {
  // A motion that is prescribed everywhere keeps every particle intact, here a plane strain.
  const auto warnings = [](bool intact) {
    const auto plan = plan_of(block(
        12, 12, 1,
        Keys{{"poisson", 0.25}} + surface("failures.cohesive", {{"strength", 4e6},
                                                                {"fracture_energy", 10},
                                                                {"length", 4e-3},
                                                                {"intact_near_supports", intact}}),
        stage("loads.fixed", {{"on", "all"}, {"axes", "z"}})));
    return plan_json(*plan).at("warnings").dump();
  };
  expect_in(warnings(true), {"144 of 144 particles", "no damage grows"});
  EXPECT_EQ(warnings(false).find("no damage grows"), std::string::npos);
}

TEST(Cohesive, StaticSolversPlanStepsForDamage) {
  const auto steps = [](const Keys& more) {
    return plan_of(SceneBuilder{}
                       .lattice("lattices.cubic", 1e-3, box_mm(6, 6, 6))
                       .material("materials.elastic",
                                 Keys{{"young", 1e10}, {"density", 2500}, {"poisson", 0.25}} + more)
                       .solver("solvers.static", {{"damage_step", 0.1}})
                       .text())
        ->steps();
  };
  EXPECT_EQ(steps({}), 1U);
  EXPECT_EQ(steps(surface("failures.cohesive", {{"strength", 4e6}, {"fracture_energy", 10}})), 31U);
}

}  // namespace strength_surface_test
