// Energy and elastic constants of the infinite mirrored layer under uniform strains.
#pragma once

#include <model/waves.hpp>

namespace hyperlattice {

/// Number of uniform strains: xx, yy, zz, 2 yz, 2 xz, 2 xy, and ww, the stretch of the membrane's
/// thickness.
inline constexpr std::size_t uniform_strains = 7;

/// Second derivatives by the strains of the energy of one site of one layer, N m. Divided by the
/// volume of the site they are elastic constants.
using StrainEnergy = std::array<std::array<double, uniform_strains>, uniform_strains>;
StrainEnergy strain_energy(const InfiniteLattice& lattice);

/// Elastic constants of one layer, Pa, with relaxed height; strains xx, yy, zz, 2 yz, 2 xz, 2 xy
/// (Voigt).
using LayerStiffness = std::array<std::array<double, 6>, 6>;
LayerStiffness layer_stiffness(const InfiniteLattice& lattice, double site_volume);

/// Returns the constants of a cubic lattice along its axes; for other lattices means over the axes.
ElasticConstants mean_constants(const LayerStiffness& stiffness);

}  // namespace hyperlattice
