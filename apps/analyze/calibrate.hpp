// Calibration: the springs of an infinite lattice from Young's modulus and the Poisson ratio, and
// back.
#pragma once

#include <analyze/membrane_choice.hpp>
#include <analyze/virtual_test.hpp>

namespace hyperlattice {

/// The arguments of the command line; those not given are empty.
struct CalibrationChoice {
  MembraneChoice membrane;
  std::optional<double> young;    ///< Pa
  std::optional<double> spacing;  ///< l, m
  /// "closed_form": exact for the infinite lattice; or "paper": polynomials (11) and (13).
  std::string parameters = "closed_form";
};

/// The result of a calibration.
struct Calibration {
  ChosenMembrane chosen;
  ElasticPair pair;             ///< by the method of CalibrationChoice::parameters
  ElasticPair infinite;         ///< of the infinite lattice with these springs
  double zener = 1;             ///< Zener ratio A of the infinite lattice; 1 if isotropic
  std::optional<double> young;  ///< Pa
  std::optional<double> stiffness_per_spacing;  ///< k / l, Pa
  std::optional<double> base_stiffness;         ///< k, N/m
};

/// Calibrates a membrane. Throws InputError with every fault: arguments that contradict each other,
/// and values for which no lattice is stable, with the stable range and the membranes that reach
/// the value.
Calibration calibrate(const CalibrationChoice& choice, const LatticeGeometry& geometry);

/// Returns the constants of the infinite lattice with these stiffness ratios. `volumetric`: K_v of
/// the volumetric energy, k/l.
ElasticPair elastic_pair(const LatticeGeometry& geometry, const calibration::Ratios& ratios,
                         double volumetric = 0);

/// Returns the same for a listed lattice under affine strain (all springs see the mean strain);
/// nothing for a grid, where the strain is affine anyway.
std::optional<ElasticPair> affine_pair(const LatticeGeometry& geometry,
                                       const calibration::Ratios& ratios);

// The results as JSON and as text.
Json calibration_json(const Calibration& calibration);
std::string calibration_text(const Calibration& calibration);
Json measured_json(const VirtualTestResult& measured, const VirtualTest::Options& options);
std::string measured_text(const VirtualTestResult& measured, const VirtualTest::Options& options,
                          const ElasticPair& infinite);

}  // namespace hyperlattice
