// The paper's membranes on any lattice: k_beta goes with spring class 0, k_gamma with class 1. Which lambda has a Poisson ratio, and which
// Poisson ratios a stable lattice reaches.
#pragma once

#include <analyze/spring_lattice.hpp>

#include <hyperlattice/calibration.hpp>

#include <optional>

namespace hyperlattice {

/// Whether lambda means something to it: to all but none and free.
bool has_lambda(calibration::Membrane membrane);

/// Springs of stiffness k = 1 N/m with these in the fourth dimension.
SpringLattice with_ratios(const LatticeGeometry& geometry, const calibration::Ratios& ratios);

/// The lambda that has this Poisson ratio along [100], stable or not; infinite at the ratio that lambda approaches without end; nothing for
/// membranes without a lambda. Exact for any lattice, because its elastic constants are linear in lambda.
std::optional<double> lambda_for(const LatticeGeometry& geometry, calibration::Membrane membrane, double poisson);

/// Poisson ratios for which the mirrored lattice is stable; nothing for membranes without a lambda.
std::optional<calibration::Reach> reach(const LatticeGeometry& geometry, calibration::Membrane membrane);

/// Whether the mirrored lattice is, by a search of the waves: at the very edge it may be taken for stable.
bool is_stable(const LatticeGeometry& geometry, const calibration::Ratios& ratios);

/// The same of a membrane that has a lambda, the edge excluded.
bool is_stable(const LatticeGeometry& geometry, calibration::Membrane membrane, double lambda);

/// What to add to a message about a lambda whose lattice is unstable: those that are stable, and membranes that are stable with this one.
std::string stable_sentence(const LatticeGeometry& geometry, calibration::Membrane membrane, double lambda);

/// What to add to a message about a Poisson ratio out of a membrane's reach: that reach, and who reaches it.
std::string reach_sentence(const LatticeGeometry& geometry, calibration::Membrane membrane, double poisson);

}  // namespace hyperlattice
