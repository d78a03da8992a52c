// Stability of the cubic lattice of 18 neighbours in closed form. It gives the same answer as the
// search of the Brillouin zone, which works for any lattice. Stiffnesses in units of k, Delta = l.
#pragma once

#include <hyperlattice/calibration.hpp>

namespace hyperlattice {

/// Returns the smallest decisive stiffness over k; the lattice is stable if it is positive.
double mirrored_margin(const calibration::Ratios& ratios);  ///< of motions of the mirrored layer
/// The same for the further motions of the two-layer lattice; 0 still counts as stable.
double opposed_margin(const calibration::Ratios& ratios);

}  // namespace hyperlattice
