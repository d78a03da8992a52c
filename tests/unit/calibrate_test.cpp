// Calibration of the infinite lattice against the closed forms and an independent table, in both
// directions and with the polynomials of the paper; and the fits.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <analyze/calibrate.hpp>
#include <analyze/calibration_curve.hpp>
#include <analyze/load_lattice.hpp>
#include <support/reference_table.hpp>

namespace calibrate_test {
using namespace hyperlattice;
using calibration::Membrane;

const LatticeGeometry& cubic() {
  static Host host;
  static const LatticeGeometry geometry = load_lattice(host, "lattices.cubic");
  return geometry;
}

std::string name(Membrane membrane) {
  return std::string(calibration::membrane_names[static_cast<std::size_t>(membrane)]);
}

CalibrationChoice of(Membrane membrane, std::optional<double> poisson,
                     std::optional<double> lambda = {}) {
  CalibrationChoice choice;
  choice.membrane.membrane = name(membrane);
  choice.membrane.poisson = poisson;
  choice.membrane.lambda = lambda;
  return choice;
}

TEST(Calibrate, TheTableOfTheInfiniteLattice) {
  int compared = 0;
  for (const test::Row& row : test::nu_eta_table()) {
    if (row.values.at("nu_N10").empty() || row.number("lambda") == -2)
      continue;  // unstable or near a limit
    const Calibration found = calibrate(of(row.membrane, {}, row.number("lambda")), cubic());
    EXPECT_NEAR(found.pair.poisson, row.number("nu_inf"), 1e-6) << row.text;
    EXPECT_NEAR(found.pair.modulus_ratio, row.number("eta_inf"), 1e-6) << row.text;
    EXPECT_NEAR(found.zener, row.number("A_inf"), 1e-6) << row.text;
    ++compared;
  }
  EXPECT_EQ(compared, 87);
}

// I-m: k = E l (1 + 5 nu) / (9 (1 + nu) (1 - 2 nu)).
TEST(Calibrate, StiffnessFollowsFromEAndSpacing) {
  CalibrationChoice choice = of(Membrane::I_m, 0.05);
  choice.young = 10e9;
  choice.spacing = 2e-3;
  const Calibration found = calibrate(choice, cubic());
  const double expected = 10e9 * 1.25 / (9 * 1.05 * 0.9);
  EXPECT_NEAR(*found.stiffness_per_spacing, expected, 1e-10 * expected);
  EXPECT_NEAR(*found.base_stiffness, 2e-3 * expected, 1e-12 * expected);
  EXPECT_FALSE(calibrate(of(Membrane::I_m, 0.05), cubic()).stiffness_per_spacing);
}

// Converts any E, and any Poisson ratio that a membrane reaches, to lambda and k, and back.
TEST(Calibrate, ThereAndBack) {
  ASSERT_TRUE(rc::check([] {
    const auto membrane =
        *rc::gen::element(Membrane::I, Membrane::II, Membrane::III, Membrane::IV, Membrane::I_m);
    const calibration::Reach reach = calibration::reach(membrane);
    const double share = *rc::gen::inRange(1, 1000) / 1000.0,
                 poisson = reach.low + share * (reach.high - reach.low);
    CalibrationChoice there = of(membrane, poisson);
    there.young = *rc::gen::inRange(1, 1000) * 1e8;
    const Calibration found = calibrate(there, cubic());
    RC_ASSERT(std::abs(*found.chosen.lambda - calibration::lambda(membrane, poisson)) <=
              1e-9 * (1 + std::abs(*found.chosen.lambda)));
    RC_ASSERT(std::abs(found.pair.poisson - poisson) < 1e-10);
    const Calibration back = calibrate(of(membrane, {}, *found.chosen.lambda), cubic());
    RC_ASSERT(std::abs(back.pair.poisson - poisson) < 1e-10);
    const double young =
        *found.stiffness_per_spacing *
        calibration::elasticity(calibration::ratios(membrane, *found.chosen.lambda)).modulus();
    RC_ASSERT(std::abs(young - *there.young) < 1e-9 * *there.young);
  }));
}

TEST(Calibrate, FreeMixturesThatAreStable) {
  ASSERT_TRUE(rc::check([] {
    CalibrationChoice choice = of(Membrane::free, {});
    const calibration::Ratios ratios{*rc::gen::inRange(1, 500) / 100.0,
                                     *rc::gen::inRange(0, 500) / 100.0,
                                     *rc::gen::inRange(0, 500) / 100.0, false};
    choice.membrane.k_alpha = std::to_string(ratios.alpha);
    choice.membrane.k_beta = ratios.beta;
    choice.membrane.k_gamma = ratios.gamma;
    const Calibration found = calibrate(choice, cubic());
    const calibration::Elasticity expected = calibration::elasticity(ratios);
    RC_ASSERT(std::abs(found.pair.poisson - expected.poisson()) < 1e-12);
    RC_ASSERT(std::abs(found.pair.modulus_ratio - expected.modulus_ratio()) < 1e-11);
    RC_ASSERT(std::abs(found.zener - expected.zener()) < 1e-12);
  }));
}

TEST(Calibrate, ThePapersPolynomials) {
  for (const double poisson : {0.04, 0.05, 0.1, 0.2, 0.23, 0.2464}) {
    CalibrationChoice choice = of(Membrane::I_m, poisson);
    choice.parameters = "paper";
    choice.young = 1e9;
    const Calibration there = calibrate(choice, cubic());
    const double lambda = *there.chosen.lambda;
    EXPECT_DOUBLE_EQ(
        lambda,
        ((-211.13493779 * poisson + 162.84655851) * poisson - 55.42449719) * poisson + 6.92902211);
    EXPECT_DOUBLE_EQ(there.pair.modulus_ratio,
                     (-0.0078506 * lambda + 0.41613615) * lambda + 1.00369223);
    EXPECT_EQ(there.pair.poisson, poisson);
    EXPECT_NEAR(there.infinite.poisson, poisson, 4e-3);  // a cube of 20^3 particles has a surface
    EXPECT_NE(there.infinite.poisson, poisson);
    EXPECT_NEAR(*there.stiffness_per_spacing, 0.4e9 / there.pair.modulus_ratio, 1);
    CalibrationChoice back = of(Membrane::I_m, {}, lambda);
    back.parameters = "paper";
    EXPECT_NEAR(calibrate(back, cubic()).pair.poisson, poisson, 1e-12);
  }
}

TEST(Calibrate, FitsOfPointsOnTheCurve) {
  const Curve curve = calibration_curve({0, 4.5, 10}, of(Membrane::II, {}), cubic(), nullptr);
  ASSERT_EQ(curve.points.size(), 10u);
  EXPECT_DOUBLE_EQ(curve.points[3].lambda, 1.5);
  EXPECT_NEAR(curve.points[3].infinite.poisson, 0.185714, 1e-6);
  EXPECT_FALSE(curve.has_paper_fit);
  // In least squares, the residual is orthogonal to each power.
  double sums[4] = {};
  for (const CurvePoint& point : curve.points) {
    const double nu = point.infinite.poisson,
                 rest = calibration::polynomial(curve.lambda_of_poisson.coefficients, nu) -
                        point.lambda;
    EXPECT_LE(std::abs(rest), curve.lambda_of_poisson.largest_error * (1 + 1e-9));
    for (int n = 0; n < 4; ++n) sums[n] += rest * std::pow(nu, n);
  }
  for (const double sum : sums) EXPECT_NEAR(sum, 0, 1e-11);
  EXPECT_LT(curve.modulus_ratio_of_lambda.largest_error, 0.01);
}

}  // namespace calibrate_test
