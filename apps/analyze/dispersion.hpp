// Dispersion curves: the frequencies of waves along the main directions of a lattice.
#pragma once

#include <model/waves.hpp>

#include <string>

namespace hyperlattice {

/// Returns a CSV table of waves along [100], [110] and [111], from q = 0 to the turning point of
/// the curves; in the cubic lattice (pi, 0, 0), (pi, pi, 0), (pi, pi, pi) radians per spacing.
/// Columns: direction, q_x, q_y, q_z, mirrored_1 ... and opposed_1 ..., the frequencies omega /
/// sqrt(k/m) of both sectors, ascending. A growing wave has its growth rate, as a negative number,
/// in place of a frequency. `base_stiffness` is k, N/m.
std::string dispersion_csv(const InfiniteLattice& lattice, double base_stiffness);

}  // namespace hyperlattice
