// Dispersion curves: the frequencies of the waves along the lattice's main directions.
#pragma once

#include <model/waves.hpp>

#include <string>

namespace hyperlattice {

/// A CSV table of waves along [100], [110] and [111], each from q = 0 to where the curves turn
/// back; in the cubic lattice (pi, 0, 0), (pi, pi, 0), (pi, pi, pi) radians a spacing: direction,
/// q_x, q_y, q_z, mirrored_1 ... and opposed_1 ..., the frequencies omega / sqrt(k/m) of both
/// sectors, ascending. A wave that grows has its rate, negative, in place of a frequency.
/// `base_stiffness` is k, N/m.
std::string dispersion_csv(const InfiniteLattice& lattice, double base_stiffness);

}  // namespace hyperlattice
