// Stability of the cubic lattice of 18 neighbours in closed form: what the search of the Brillouin
// zone finds for any lattice, known here beforehand. All numbers in units of k, Delta = l.
#pragma once

#include <hyperlattice/calibration.hpp>

namespace hyperlattice {

/// The least of the stiffnesses that decide: positive means stable.
double mirrored_margin(const calibration::Ratios& ratios);  ///< of the mirrored layer
double opposed_margin(const calibration::Ratios& ratios);  ///< of what the two-layer lattice can do
                                                           ///< besides; 0 is still stable

}  // namespace hyperlattice
