// Figure 2 of Zhao 2017. The virtual test with 20^3 particles gives the fits (11) and (13); other
// sizes do not.
#include <gtest/gtest.h>
#include <analyze/calibration_curve.hpp>
#include <analyze/load_lattice.hpp>
#include <support/components.hpp>

namespace figure_2_test {
using namespace hyperlattice;

Curve figure(int particles, double strain) {
  Host host;
  CalibrationChoice choice;
  choice.membrane.membrane = "I-m";
  VirtualTest::Options options;
  options.lattice = "lattices.cubic";
  options.particles = particles;
  options.strain = strain;
  VirtualTest measures = test::virtual_test(host, options);
  return calibration_curve({0, 4.5, 10}, choice, load_lattice(host, options.lattice), &measures);
}

double worst(const std::vector<double>& found, std::span<const double> expected) {
  double largest = 0;
  for (std::size_t n = 0; n < found.size(); ++n)
    largest = std::max(largest, std::abs(found[n] / expected[n] - 1));
  return largest;
}

TEST(FigureTwo, TheCoefficientsOfThePaper) {
  const Curve curve = figure(20, 1e-3);
  EXPECT_LT(worst(curve.lambda_of_poisson.coefficients, calibration::paper_cubic), 2e-3);
  EXPECT_LT(worst(curve.modulus_ratio_of_lambda.coefficients, calibration::paper_quadratic), 2e-4);
  double apart = 0;  // distance of the two cubics at the points
  for (const CurvePoint& point : curve.points) {
    const double nu = point.measured->poisson;
    apart =
        std::max(apart, std::abs(calibration::polynomial(curve.lambda_of_poisson.coefficients, nu) -
                                 calibration::paper_lambda(nu)));
  }
  EXPECT_LT(apart, 5e-4);
}

TEST(FigureTwo, TheSameComputedIndependently) {
  const Curve finite = figure(20, 1e-3), linear = figure(20, 1e-6);
  const double cubic[] = {-210.9130, 162.7447, -55.4105, 6.92874},
               quadratic[] = {-0.0078504, 0.4161849, 1.0037013};
  const double linear_cubic[] = {-210.953, 162.737, -55.400, 6.9269},
               linear_quadratic[] = {-0.0078445, 0.416384, 1.003699};
  EXPECT_LT(worst(finite.lambda_of_poisson.coefficients, cubic), 2e-6);
  EXPECT_LT(worst(finite.modulus_ratio_of_lambda.coefficients, quadratic), 1e-5);
  EXPECT_LT(worst(linear.lambda_of_poisson.coefficients, linear_cubic), 1e-5);
  EXPECT_LT(worst(linear.modulus_ratio_of_lambda.coefficients, linear_quadratic), 1e-5);
}

TEST(FigureTwo, AnotherCubeHasOtherCoefficients) {  // hence the agreement is significant
  EXPECT_GT(worst(figure(10, 1e-3).lambda_of_poisson.coefficients, calibration::paper_cubic), 0.05);
}

}  // namespace figure_2_test
