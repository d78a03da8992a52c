// The paper's membranes on the infinite lattice of a geometry: functions of
// hyperlattice/membranes.hpp for a LatticeGeometry.
#pragma once

#include <model/spring_lattice.hpp>

#include <hyperlattice/membranes.hpp>

#include <optional>

namespace hyperlattice {

using membranes::has_lambda;

/// Returns the lattice with base springs of k = 1 N/m and these ratios in the fourth dimension.
/// `volumetric`: K_v of the volumetric energy, k/l.
SpringLattice with_ratios(const LatticeGeometry& geometry, const calibration::Ratios& ratios,
                          double volumetric = 0);

/// Returns the ratios of a membrane; in I-m, k_gamma / k_beta is that of the lattice.
calibration::Ratios ratios_of(const LatticeGeometry& geometry, calibration::Membrane membrane,
                              double lambda);

/// Returns the lambda with this Poisson ratio along [100], stable or not; infinity if no lambda has
/// it; nothing for membranes without a lambda.
std::optional<double> lambda_for(const LatticeGeometry& geometry, calibration::Membrane membrane,
                                 double poisson);

/// Returns the range of Poisson ratios with a stable mirrored lattice; nothing for membranes
/// without a lambda.
std::optional<calibration::Reach> reach(const LatticeGeometry& geometry,
                                        calibration::Membrane membrane);

/// Returns whether the mirrored lattice is stable; the edge of stability does not count. The
/// membrane must have a lambda.
bool is_stable(const LatticeGeometry& geometry, calibration::Membrane membrane, double lambda);

/// For an error message about an unstable lambda: returns the stable values of lambda, and the
/// membranes that are stable with this one.
std::string stable_sentence(const LatticeGeometry& geometry, calibration::Membrane membrane,
                            double lambda);

/// For an error message about a Poisson ratio out of reach: returns the membrane's range, and the
/// membranes that reach this value.
std::string reach_sentence(const LatticeGeometry& geometry, calibration::Membrane membrane,
                           double poisson);

}  // namespace hyperlattice
