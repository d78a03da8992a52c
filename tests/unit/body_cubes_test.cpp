// The cubes that pictures draw: their volume is that of the body, and each particle has its part.
#include <model/body_cubes.hpp>

#include <support/body.hpp>
#include <support/models.hpp>

#include <gtest/gtest.h>

#include <numbers>

namespace body_cubes_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

/// Returns the volume of the cubes of each particle.
std::vector<double> volumes(const CubeGrid& cubes, std::uint64_t particles) {
  std::vector<double> of(particles, 0.0);
  for (const std::uint32_t particle : cubes.particle)
    if (particle != BodyCubes::no_particle) of.at(particle) += cubes.edge * cubes.edge * cubes.edge;
  return of;
}
/// Builds a body of this lattice.
BuiltScene body_of(const Stages& lattice) {
  return build(lattice +
               stage("materials.elastic", {{"young", 1}, {"poisson", 0.25}, {"density", 1}}));
}
double sum(const std::vector<double>& values) {
  double all = 0;
  for (const double value : values) all += value;
  return all;
}

TEST(BodyCubes, AParticleIsTheMiddleOfItsCube) {
  const Body body = cubic_body(test::box({4, 3, 2}), 1);
  const CubeGrid cubes = cubes_of(body);
  ASSERT_EQ(cubes.particle.size(), 24U);
  for (std::uint32_t n = 0; n < 24; ++n) {
    EXPECT_EQ(cubes.particle[n], n);
    const Vec3 middle = cubes.origin + Vec3{n % 4 + 0.5, n / 4 % 3 + 0.5, n / 12 + 0.5};
    EXPECT_LT(norm(body.position(n) - middle), 1e-12);
  }
}

TEST(BodyCubes, EighthsOfCellsAreTheSharesOfParticles) {
  for (const Region& region : {test::box({4, 3, 2}), ball(2, 5)}) {
    const Body body = cubic_body(region, 1, Boundary::cells);
    const std::vector<double> of = volumes(cubes_of(body), body.particles);
    for (Particle n = 0; n < body.particles; ++n) EXPECT_DOUBLE_EQ(of[n], body.share(n)) << n;
  }
}

TEST(BodyCubes, PartialCellsHaveTheVolumeOfTheShapeInTheMean) {
  const double radius = 20.3, exact = 4.0 / 3 * std::numbers::pi * std::pow(radius, 3);
  const Json shape{{"sphere", {{"centre", {0, 0, 0}}, {"radius", radius}}}};
  const auto built = body_of(
      stage("lattices.cubic", {{"spacing", 1}, {"boundary", "partial_cells"}, {"shape", shape}}));
  const Body& body = built->body;
  EXPECT_NEAR(sum(volumes(cubes_of(body), body.particles)), exact, 0.01 * exact);
}

TEST(BodyCubes, OtherLatticesFillTheirShape) {
  for (const char* lattice : {"lattices.bcc", "lattices.fcc"}) {
    const auto built =
        body_of(stage(lattice, {{"spacing", 1}, {"shape", test::box({}, {4, 3, 2})}}));
    const std::vector<double> of = volumes(cubes_of(built->body), built->body.particles);
    EXPECT_DOUBLE_EQ(sum(of), 24) << lattice;
    for (const double volume : of) EXPECT_GT(volume, 0) << lattice;
  }
}

}  // namespace body_cubes_test
