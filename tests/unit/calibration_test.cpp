// Conversion between E, nu and springs, against an independently computed table, the printed closed
// forms, and published numbers.
#include <hyperlattice/calibration.hpp>

#include <gtest/gtest.h>
#include <support/reference_table.hpp>

namespace calibration_test {
using namespace hyperlattice;
using namespace hyperlattice::calibration;

constexpr Membrane with_lambda[] = {Membrane::I, Membrane::II, Membrane::III, Membrane::IV,
                                    Membrane::I_m};

TEST(Calibration, AgreesWithTheTableOfTheInfiniteLattice) {
  int rows = 0;
  for (const test::Row& row : test::nu_eta_table()) {
    const double lambda_given = row.number("lambda");
    const Elasticity e = elasticity(ratios(row.membrane, lambda_given));
    EXPECT_NEAR(e.poisson(), row.number("nu_inf"), 1e-6) << row.text;
    EXPECT_NEAR(e.modulus_ratio(), row.number("eta_inf"), 1e-6) << row.text;
    EXPECT_NEAR(e.zener(), row.number("A_inf"), 1e-6) << row.text;
    if (e.poisson() < 0.2666) {  // lambda of III has a pole at 4/15
      EXPECT_NEAR(lambda(row.membrane, e.poisson()), lambda_given,
                  1e-9 * (1 + std::abs(lambda_given)))
          << row.text;
    }
    ++rows;
  }
  EXPECT_EQ(rows, 98);
}

// The closed forms in the notation of each membrane, without the sums C1 to C4.
TEST(Calibration, ClosedFormsOfEachMembrane) {
  for (const double L : {0.1, 1.0, 2.8, 7.0}) {
    const auto nu = [L](Membrane m) { return elasticity(ratios(m, L)).poisson(); };
    const auto eta = [L](Membrane m) { return elasticity(ratios(m, L)).modulus_ratio(); };
    EXPECT_NEAR(nu(Membrane::I), (144 - 25 * L) / (2 * (288 + 59 * L)), 1e-14);
    EXPECT_NEAR(nu(Membrane::II), (8 - L) / (2 * (16 + L)), 1e-14);
    EXPECT_NEAR(nu(Membrane::I_m), (7 - L) / (28 + 5 * L), 1e-14);
    EXPECT_NEAR(nu(Membrane::III), 2 * (3 + 2 * L) / (3 * (8 + 5 * L)), 1e-14);
    EXPECT_NEAR(nu(Membrane::IV), 2 / (8 + L), 1e-14);
    EXPECT_NEAR(eta(Membrane::I), (12 + 7 * L) * (240 + 31 * L) / (10 * (288 + 59 * L)), 1e-13);
    EXPECT_NEAR(eta(Membrane::II), (4 + L) * (40 + L) / (10 * (16 + L)), 1e-13);
    EXPECT_NEAR(eta(Membrane::I_m), 2 * (2 + L) * (35 + 4 * L) / (5 * (28 + 5 * L)), 1e-13);
    EXPECT_NEAR(eta(Membrane::III), (12 + 7 * L) * (30 + 19 * L) / (45 * (8 + 5 * L)), 1e-13);
    EXPECT_NEAR(eta(Membrane::IV), (4 + L) * (10 + L) / (5 * (8 + L)), 1e-13);
  }
}

TEST(Calibration, FigureFiveParameters) {  // nu = 0.1, E = 10 GPa: lambda, eta, k / (E l), A
  const std::map<Membrane, std::array<double, 4>> expected{
      {Membrane::I, {2.3478, 2.0852, 0.19183, 1.083}},
      {Membrane::II, {4, 1.76, 0.22727, 0.5}},
      {Membrane::I_m, {2.8, 2.112, 0.18939, 1}},
      {Membrane::III, {-1.44, 0.1408, 2.8409, 0.25}},
      {Membrane::IV, {12, 3.52, 0.11364, 0.25}}};
  for (const auto& [membrane, values] : expected) {
    const double L = lambda(membrane, 0.1);
    const Elasticity e = elasticity(ratios(membrane, L));
    EXPECT_NEAR(L, values[0], 5e-5);
    EXPECT_NEAR(e.modulus_ratio(), values[1], 5e-5);
    EXPECT_NEAR(stiffness_bulk(10e9, 1e-3, e.modulus_ratio()) / (10e9 * 1e-3), values[2], 5e-5);
    EXPECT_NEAR(e.zener(), values[3], 5e-4);
  }
}

TEST(Calibration, OnlyMembraneImIsIsotropicForEveryLambda) {
  for (const double L : {0.5, 2.0, 6.0}) {
    const Elasticity e = elasticity(ratios(Membrane::I_m, L));
    EXPECT_NEAR(e.zener(), 1, 1e-14);
    EXPECT_NEAR(e.poisson(), e.poisson_shear(), 1e-14);
  }
  EXPECT_EQ(lambda(Membrane::I_m, 0.25), 0);
}

TEST(Calibration, ReachEndsWhereTheMembraneDoes) {
  for (const Membrane membrane : with_lambda) {
    const Reach reach = calibration::reach(membrane);
    const double inside = 0.5 * (reach.low + reach.high);
    EXPECT_TRUE(reach.holds(inside));
    EXPECT_FALSE(reach.holds(reach.low));
    EXPECT_FALSE(reach.holds(reach.high + 1e-9));
    EXPECT_EQ(reach.holds(reach.high), !reach.open);
    EXPECT_NEAR(elasticity(ratios(membrane, lambda(membrane, inside))).poisson(), inside, 1e-13);
  }
}

TEST(Calibration, PapersPolynomials) {  // printed beside the paper's fits
  EXPECT_NEAR(paper_lambda(0.0), 6.92902211, 1e-12);
  EXPECT_NEAR(paper_lambda(0.24646), 0, 5e-4);
  EXPECT_NEAR(paper_lambda(0.25), -0.0482, 5e-4);
  EXPECT_NEAR(paper_modulus_ratio(0), 1.00369223, 1e-12);
  // The fits are close to the infinite lattice.
  for (const double nu : {0.05, 0.1, 0.15, 0.2, 0.23}) {
    const Elasticity e = elasticity(ratios(Membrane::I_m, paper_lambda(nu)));
    EXPECT_NEAR(e.poisson(), nu, 2.6e-3);
    EXPECT_NEAR(e.modulus_ratio() / paper_modulus_ratio(paper_lambda(nu)), 1, 5e-3);
  }
}

// Each particle has 3 orthogonal and 6 diagonal springs.
TEST(Calibration, EquationFifteenIsTheBulkValueWithoutSurfaces) {
  EXPECT_NEAR(stiffness_eq15(1e9, 1000 * 1e-9, 1000 * 15 * 1e-6, 1.5),
              stiffness_bulk(1e9, 1e-3, 1.5), 1e-6);
}

}  // namespace calibration_test
