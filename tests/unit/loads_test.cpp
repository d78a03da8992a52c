// The forces of each load on the particles, and loads that act together: resultants, areas,
// symmetry, conflicts, empty regions.
#include <support/models.hpp>

#include <gtest/gtest.h>

#include <numbers>

namespace loads_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

BuiltScene box_with(const Stages& loads) { return build(box_lattice(3, 4, 5) + elastic() + loads); }
std::string box_faults(const Stages& loads) {
  return faults_of(box_lattice(3, 4, 5) + elastic() + loads);
}

BuiltScene sphere_with(const Stages& load) {
  const Json shape = {{"hollow_sphere", {{"inner_radius", 8e-3}, {"outer_radius", 15e-3}}}};
  return build(stage("lattices.cubic", {{"spacing", 1e-3}, {"shape", shape}}) + elastic() + load);
}

Vec3 resultant(const Load& load) {
  Vec3 sum;
  for (const LoadedParticle& loaded : load.particles) sum = sum + loaded.force;
  return sum;
}

void expect_near(Vec3 found, Vec3 expected, double tolerance) {
  EXPECT_NEAR(found.x, expected.x, tolerance);
  EXPECT_NEAR(found.y, expected.y, tolerance);
  EXPECT_NEAR(found.z, expected.z, tolerance);
}

TEST(Loads, BlastIsRadialAndHasTheTrueArea) {
  for (const auto& [region, area, sign] :
       {std::tuple{"inner_surface", 4 * std::numbers::pi * 64e-6, 1.0},
        {"outer_surface", 4 * std::numbers::pi * 225e-6, -1.0}}) {
    const BuiltScene built = sphere_with(
        stage("loads.blast", {{"on", region}, {"peak", 2e6}, {"rise", 1e-6}, {"fall", 3e-6}}));
    const Load& load = built->loads[0];
    double radial = 0;
    for (const LoadedParticle& loaded : load.particles) {
      const Vec3 at = built->body.position(loaded.particle);
      EXPECT_LT(norm(cross(at, loaded.force)), 1e-12 * norm(at) * norm(loaded.force));
      // Pressure in the cavity acts outwards; pressure on the outer surface acts inwards.
      EXPECT_GT(sign * dot(at, loaded.force), 0);
      radial += norm(loaded.force);
    }
    EXPECT_NEAR(radial, 2e6 * area, 1e-9 * 2e6 * area);
    expect_near(resultant(load), {}, 1e-10 * radial);
  }
}

TEST(Loads, BlastWithoutAKnownAreaTakesThatOfTheCells) {
  const BuiltScene built = sphere_with(
      R"({ "type": "loads.blast", "on": { "intersection": ["inner_surface", "all"] }, "peak": 1, "rise": 1, "fall": 1 })");
  double radial = 0;
  for (const LoadedParticle& loaded : built->loads[0].particles) radial += norm(loaded.force);
  EXPECT_NEAR(radial, 4 * std::numbers::pi * 64e-6,
              // The area of the projected steps is close to that of the sphere.
              0.06 * 4 * std::numbers::pi * 64e-6);
  EXPECT_GT(std::abs(radial / (4 * std::numbers::pi * 64e-6) - 1), 1e-6);
  const BuiltScene given = sphere_with(
      R"({ "type": "loads.blast", "on": "inner_surface", "area": "3 mm2", "peak": 1, "rise": 1, "fall": 1 })");
  radial = 0;
  for (const LoadedParticle& loaded : given->loads[0].particles) radial += norm(loaded.force);
  EXPECT_NEAR(radial, 3e-6, 1e-15);
}

TEST(Loads, BlastIsATriangleInTime) {
  const BuiltScene built = sphere_with(
      R"({ "type": "loads.blast", "on": "inner_surface", "peak": 1, "rise": "5 us", "fall": "15 us", "start": "2 us" })");
  const Load& load = built->loads[0];
  for (const auto& [time, expected] : {std::pair{0.0, 0.0},
                                       {2e-6, 0.0},
                                       {4.5e-6, 0.5},
                                       {7e-6, 1.0},
                                       {14.5e-6, 0.5},
                                       {22e-6, 0.0},
                                       {1.0, 0.0}})
    EXPECT_NEAR(load.factor(time), expected, 1e-12) << time;
  const std::vector<double> corners{2e-6, 7e-6, 22e-6};
  ASSERT_EQ(built->loads.corners.size(), 3u);
  for (std::size_t n = 0; n < 3; ++n) EXPECT_NEAR(built->loads.corners[n], corners[n], 1e-18);
}

TEST(Loads, PressureOnAFaceHasTheExactResultant) {
  const BuiltScene built = box_with(
      R"({ "type": "loads.pressure", "on": "x_max", "pressure": 7, "rise": 2 }, { "type": "loads.pressure", "on": "surface", "pressure": 7 })");
  EXPECT_EQ(built->loads[0].particles.size(), 20u);
  expect_near(resultant(built->loads[0]), {-7.0 * 4 * 5, 0, 0}, 1e-12);
  expect_near(resultant(built->loads[1]), {}, 1e-12);  // the pressure acts from all sides
  EXPECT_EQ(built->loads[0].factor(1), 0.5);
  EXPECT_EQ(built->loads[0].factor(3), 1);
  EXPECT_EQ(built->loads[1].factor(0), 1);
  EXPECT_EQ(built->loads.corners, std::vector<double>{2});
  EXPECT_NE(
      box_faults(
          R"({ "type": "loads.pressure", "on": { "box": { "low": [1, 1, 1], "high": [2, 3, 4] } }, "pressure": 1 })")
          .find("open face"),
      std::string::npos);
}

TEST(Loads, ForceInTotalOrOnEach) {
  const BuiltScene built = box_with(
      R"({ "type": "loads.force", "on": "z_min", "total": [12, 0, 24] }, { "type": "loads.force", "on": "z_min", "each": ["1 kN", 0, 0] })");
  expect_near(resultant(built->loads[0]), {12, 0, 24}, 1e-12);
  expect_near(built->loads[0].particles[5].force, {1, 0, 2}, 1e-12);
  expect_near(resultant(built->loads[1]), {12000, 0, 0}, 1e-9);
  EXPECT_NE(box_faults(R"({ "type": "loads.force", "on": "z_min" })")
                .find("exactly one of total and each"),
            std::string::npos);
}

TEST(Loads, GravityIsTheSumOfAll) {
  const BuiltScene built = box_with(
      R"({ "type": "loads.gravity" }, { "type": "loads.gravity", "acceleration": [1, 0, 0] })");
  expect_near(built->loads.acceleration, {1, 0, -9.80665}, 1e-12);
  EXPECT_TRUE(built->loads[0].particles.empty());
}

TEST(Loads, PrescribedMotionKnowsItsAxes) {
  const BuiltScene built = box_with(R"({ "type": "loads.fixed", "on": "x_min", "axes": "xz" },
    { "type": "loads.displacement", "on": "x_max", "axes": "x", "value": ["2 mm", 5, 5], "rise": 4 },
    { "type": "loads.velocity", "on": "x_max", "axes": "y", "value": [9, 3, 9], "rise": 0.5 })");
  EXPECT_EQ(built->loads[0].particles[0].displaced, 0b101u);
  EXPECT_EQ(built->loads[0].factor(1e9), 0);
  const LoadedParticle &moved = built->loads[1].particles[0],
                       &driven = built->loads[2].particles[0];
  EXPECT_EQ(moved.displaced, 1u);
  expect_near(moved.displacement, {2e-3, 0, 0}, 1e-15);
  EXPECT_EQ(driven.driven, 2u);
  expect_near(driven.velocity, {0, 3, 0}, 1e-15);
  EXPECT_EQ(built->loads.corners, (std::vector<double>{0.5, 4}));
}

TEST(Loads, StartVelocityTranslatesAndSpins) {
  const BuiltScene built = box_with(
      R"({ "type": "loads.start_velocity", "linear": [1, 2, 3], "angular": [0, 0, 2] }, { "type": "loads.start_velocity", "on": "x_min", "linear": [10, 0, 0] })");
  Particle next = 0;
  for (const StartVelocity& one : built->loads.start_velocities) {
    ASSERT_EQ(one.first, next);
    for (; next < one.first + one.count; ++next) {
      const Vec3 arm = built->body.position(next) - Vec3{1.5, 2, 2.5};
      expect_near(one.velocity,
                  {1 - 2 * arm.y + (built->body.site(next).i == 0 ? 10 : 0), 2 + 2 * arm.x, 3},
                  1e-12);
    }
  }
  EXPECT_EQ(next, built->body.particles);
}

TEST(Loads, ParticlesThatStartAlikeTakeNoMemoryEach) {
  const BuiltScene alike = box_with(R"({ "type": "loads.start_velocity", "linear": [0, 0, -3] },
    { "type": "loads.start_velocity", "on": "z_max", "linear": [1, 0, 0] })");
  const std::vector<StartVelocity>& all = alike->loads.start_velocities;
  ASSERT_EQ(all.size(), 2U);  // the layers below the last one, and the last one
  EXPECT_EQ(all[0].count + all[1].count, alike->body.particles);
  EXPECT_EQ(all[1].first, all[0].count);
  expect_near(all[0].velocity, {0, 0, -3}, 0);
  expect_near(all[1].velocity, {1, 0, -3}, 0);
}

TEST(Loads, TwoPrescriptionsOfOneAxisAreAFaultThatNamesBoth) {
  const std::string message = box_faults(
      R"({ "type": "loads.fixed", "on": "x_min" }, { "type": "loads.velocity", "on": "z_min", "axes": "yz", "value": [0, 0, 1] })");
  for (const char* part : {"/pipeline/3", "/pipeline/2", "loads.fixed", "loads.velocity",
                           "yz of 4 particles", "(0.5, 0.5, 0.5)"})
    EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
  EXPECT_EQ(
      box_faults(
          R"({ "type": "loads.fixed", "on": "x_min", "axes": "x" }, { "type": "loads.fixed", "on": "z_min", "axes": "yz" })"),
      "");
  EXPECT_EQ(
      box_faults(
          R"({ "type": "loads.fixed", "on": "x_min" }, { "type": "loads.fixed", "on": "z_min", "axes": "yz" })"),
      "")
      << "they agree";
}

TEST(Loads, AnEmptyRegionSaysWhatItIs) {
  const std::string message = box_faults(
      R"({ "type": "loads.force", "on": { "box": { "low": [50, 0, 0], "high": [60, 1, 1] } }, "total": [1, 0, 0] },
    { "type": "loads.blast", "on": "inner_surface", "peak": 1, "rise": 1, "fall": 1 })");
  for (const char* part : {"/pipeline/2", "a box between (50, 0, 0) and (60, 1, 1)",
                           "(2.5, 3.5, 4.5)", "/pipeline/3", "closed cavities"})
    EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
}

}  // namespace loads_test
