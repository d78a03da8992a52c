// The virtual uniaxial test against a table computed independently: five membranes, cubes of 10^3,
// 20^3 and 40^3 particles.
#include <gtest/gtest.h>
#include <analyze/virtual_test.hpp>
#include <base/errors.hpp>
#include <support/components.hpp>
#include <support/reference_table.hpp>

namespace virtual_uniaxial_test {
using namespace hyperlattice;
using test::virtual_test;

constexpr double infinitesimal = 1e-6;  // strain; the table holds the linear limit
constexpr double last_digit = 2e-6;     // digit of the table, and the error due to the strain

VirtualTest::Options cube(int particles, double strain, int threads = 1) {
  VirtualTest::Options options;
  options.lattice = "lattices.cubic";
  options.particles = particles;
  options.strain = strain;
  options.threads = threads;
  return options;
}

void expect_table(int particles) {
  Host host;
  VirtualTest cube_test = virtual_test(host, cube(particles, infinitesimal));
  const std::string n = "_N" + std::to_string(particles);
  int compared = 0;
  for (const test::Row& row : test::nu_eta_table()) {
    if (row.values.at("nu" + n).empty()) continue;  // unstable
    const VirtualTestResult measured =
        cube_test.measure(calibration::ratios(row.membrane, row.number("lambda")));
    EXPECT_NEAR(measured.poisson, row.number("nu" + n), last_digit) << row.text;
    EXPECT_NEAR(measured.modulus_ratio, row.number("eta" + n), last_digit * row.number("eta" + n))
        << row.text;
    EXPECT_LE(measured.residual, 1e-8) << row.text;
    ++compared;
  }
  EXPECT_EQ(compared, 88);
}

TEST(VirtualTest, TableOfCubesOf10) { expect_table(10); }
TEST(VirtualTest, TableOfCubesOf20) { expect_table(20); }
TEST(LongVirtualTest, TableOfCubesOf40) { expect_table(40); }

// E l / k over the area of N^2 cells, computed with the same program as the table.
TEST(VirtualTest, ModulusWithoutMembrane) {
  Host host;
  EXPECT_NEAR(virtual_test(host, cube(10, infinitesimal)).measure({}).young, 2.3526, 1e-4);
  EXPECT_NEAR(virtual_test(host, cube(20, infinitesimal)).measure({}).young, 2.4277, 1e-4);
}

// At small strains a body responds to tension as to compression. The difference is of the order of
// the strain.
TEST(VirtualTest, PullingIsPressingReversed) {
  Host host;
  const calibration::Ratios ratios = calibration::ratios(calibration::Membrane::I_m, 2.8);
  const VirtualTestResult pressed = virtual_test(host, cube(6, 1e-4)).measure(ratios),
                          pulled = virtual_test(host, cube(6, -1e-4)).measure(ratios);
  EXPECT_NEAR(pressed.poisson, pulled.poisson, 1e-4);
  EXPECT_NE(pressed.poisson, pulled.poisson);
  EXPECT_NEAR(pressed.young, pulled.young, 1e-3 * pressed.young);
}

TEST(VirtualTest, ThreadsChangeNothing) {
  Host host;
  const calibration::Ratios ratios = calibration::ratios(calibration::Membrane::I_m, 1);
  const VirtualTestResult one = virtual_test(host, cube(8, 1e-3, 1)).measure(ratios),
                          three = virtual_test(host, cube(8, 1e-3, 3)).measure(ratios);
  EXPECT_EQ(one.poisson, three.poisson);
  EXPECT_EQ(one.young, three.young);
  EXPECT_EQ(one.iterations, three.iterations);
}

TEST(VirtualTest, AResidualOutOfReachIsAFailureNotALoop) {
  Host host;
  VirtualTest::Options options = cube(4, 1e-3);
  options.residual = 1e-30;
  EXPECT_THROW(virtual_test(host, options), RunError);
}

}  // namespace virtual_uniaxial_test
