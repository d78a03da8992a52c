// A membrane over a range of lambda, and the polynomials that fit it: figure 2 of Zhao 2017,
// equations (11) and (13).
#pragma once

#include <analyze/calibrate.hpp>

namespace hyperlattice {

/// Evenly spaced lambda, both ends included.
struct CurveChoice {
  double from = 0, to = 0;
  int points = 0;
};

struct CurvePoint {
  double lambda = 0;
  ElasticPair infinite;
  std::optional<Measured> measured;
  std::optional<ElasticPair>
      affine;  ///< of a listed lattice, if all its particles were strained alike

  const ElasticPair& pair() const { return measured ? *measured : infinite; }  ///< what is fitted
};

/// Coefficients of a polynomial, highest power first, and how far it is from the points at most.
struct Fit {
  std::vector<double> coefficients;
  double largest_error = 0;
};

struct Curve {
  calibration::Membrane membrane = calibration::Membrane::none;
  bool has_paper_fit = false;  ///< polynomials (11) and (13) are of this lattice
  std::vector<CurvePoint> points;
  Fit lambda_of_poisson;        ///< a cubic, as (11)
  Fit modulus_ratio_of_lambda;  ///< a quadratic, as (13)
};

/// Throws InputError with every fault.
void check_curve(const CurveChoice& choice, const CalibrationChoice& lattice,
                 const LatticeGeometry& geometry);

/// Fits by least squares. `virtual_test` measures the points; null: those of the endless lattice
/// are fitted. Throws as check_curve does.
Curve calibration_curve(const CurveChoice& choice, const CalibrationChoice& lattice,
                        const LatticeGeometry& geometry, VirtualTest* virtual_test);

Json curve_json(const Curve& curve, const VirtualTest::Options& options);
std::string curve_text(const Curve& curve, const VirtualTest::Options& options);

/// Figure 2 (b) and (c) in gnuplot's commands, one beside the other.
std::string curve_script(const Curve& curve, const VirtualTest::Options& options);

}  // namespace hyperlattice
