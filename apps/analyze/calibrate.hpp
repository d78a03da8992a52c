// From Young's modulus and the Poisson ratio to the springs of an endless lattice, and back.
#pragma once

#include <analyze/membrane_choice.hpp>
#include <analyze/virtual_test.hpp>

namespace hyperlattice {

/// As written on a command line; what was not given is empty.
struct CalibrationChoice {
  MembraneChoice membrane;
  std::optional<double> young;    ///< Pa
  std::optional<double> spacing;  ///< l, m
  std::string parameters =
      "closed_form";  ///< exact for the endless lattice; or "paper": polynomials (11) and (13)
};

struct Calibration {
  ChosenMembrane chosen;
  ElasticPair pair;                             ///< by the method asked for
  ElasticPair infinite;                         ///< what the endless lattice of these springs has
  double zener = 1;                             ///< its A: 1 if isotropic
  std::optional<double> young;                  ///< Pa
  std::optional<double> stiffness_per_spacing;  ///< k / l, Pa
  std::optional<double> base_stiffness;         ///< k, N/m
};

/// Throws InputError with every fault: what does not fit together, and values out of a stable
/// lattice's reach, with that reach and who reaches it.
Calibration calibrate(const CalibrationChoice& choice, const LatticeGeometry& geometry);

/// What the endless lattice with these springs has.
ElasticPair elastic_pair(const LatticeGeometry& geometry, const calibration::Ratios& ratios);

/// The same of a listed lattice if all particles were strained alike; nothing for others, whose
/// particles are.
std::optional<ElasticPair> affine_pair(const LatticeGeometry& geometry,
                                       const calibration::Ratios& ratios);

// For machines, and as a page.
Json calibration_json(const Calibration& calibration);
std::string calibration_text(const Calibration& calibration);
Json measured_json(const Measured& measured, const VirtualTest::Options& options);
std::string measured_text(const Measured& measured, const VirtualTest::Options& options,
                          const ElasticPair& infinite);

}  // namespace hyperlattice
