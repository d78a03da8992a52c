// The elastic constants of a membrane over a range of lambda, and the polynomials that fit them:
// figure 2 of Zhao 2017, equations (11) and (13).
#pragma once

#include <analyze/calibrate.hpp>

namespace hyperlattice {

/// Evenly spaced values of lambda; both ends are included.
struct CurveChoice {
  double from = 0, to = 0;
  int points = 0;
};

/// The constants at one lambda.
struct CurvePoint {
  double lambda = 0;
  ElasticPair infinite;
  std::optional<VirtualTestResult> measured;
  /// For a listed lattice under affine strain, see affine_pair.
  std::optional<ElasticPair> affine;

  /// The pair that the polynomials fit.
  const ElasticPair& pair() const { return measured ? *measured : infinite; }
};

/// A polynomial: its coefficients, highest power first, and its largest distance from the points.
struct Fit {
  std::vector<double> coefficients;
  double largest_error = 0;
};

/// A calibration curve and its fits.
struct Curve {
  calibration::Membrane membrane = calibration::Membrane::none;
  bool has_paper_fit = false;  ///< polynomials (11) and (13) hold for this lattice and membrane
  std::vector<CurvePoint> points;
  Fit lambda_of_poisson;        ///< a cubic, as (11)
  Fit modulus_ratio_of_lambda;  ///< a quadratic, as (13)
};

/// Checks the arguments of calibration_curve. Throws InputError with every fault.
void check_curve(const CurveChoice& choice, const CalibrationChoice& lattice,
                 const LatticeGeometry& geometry);

/// Computes the points of a curve and fits them by least squares. `virtual_test` measures the
/// points; null: the fit uses the infinite lattice. Throws as check_curve does.
Curve calibration_curve(const CurveChoice& choice, const CalibrationChoice& lattice,
                        const LatticeGeometry& geometry, VirtualTest* virtual_test);

Json curve_json(const Curve& curve, const VirtualTest::Options& options);
std::string curve_text(const Curve& curve, const VirtualTest::Options& options);

/// Returns figures 2 (b) and (c), side by side, as gnuplot commands.
std::string curve_script(const Curve& curve, const VirtualTest::Options& options);

}  // namespace hyperlattice
