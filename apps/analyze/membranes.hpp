// The paper's membranes on the endless lattice of a geometry: hyperlattice/membranes.hpp for those
// who analyse it.
#pragma once

#include <model/spring_lattice.hpp>

#include <hyperlattice/membranes.hpp>

#include <optional>

namespace hyperlattice {

using membranes::has_lambda;

/// Springs of stiffness k = 1 N/m with these in the fourth dimension.
SpringLattice with_ratios(const LatticeGeometry& geometry, const calibration::Ratios& ratios);

/// Those of a membrane, with the lattice's own k_gamma / k_beta in I-m.
calibration::Ratios ratios_of(const LatticeGeometry& geometry, calibration::Membrane membrane,
                              double lambda);

/// The lambda that has this Poisson ratio along [100], stable or not; infinite if none has; nothing
/// for membranes without a lambda.
std::optional<double> lambda_for(const LatticeGeometry& geometry, calibration::Membrane membrane,
                                 double poisson);

/// Poisson ratios for which the mirrored lattice is stable; nothing for membranes without a lambda.
std::optional<calibration::Reach> reach(const LatticeGeometry& geometry,
                                        calibration::Membrane membrane);

/// Whether the mirrored lattice of a membrane that has a lambda is stable, the edge excluded.
bool is_stable(const LatticeGeometry& geometry, calibration::Membrane membrane, double lambda);

/// For a message about a lambda whose lattice is unstable: those that are stable, and membranes
/// that are stable with this one.
std::string stable_sentence(const LatticeGeometry& geometry, calibration::Membrane membrane,
                            double lambda);

/// For a message about a Poisson ratio out of a membrane's reach: that reach, and who reaches it.
std::string reach_sentence(const LatticeGeometry& geometry, calibration::Membrane membrane,
                           double poisson);

}  // namespace hyperlattice
