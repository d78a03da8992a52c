// The energy of uniform strains of the endless mirrored layer.
#pragma once

#include <model/waves.hpp>

namespace hyperlattice {

/// Strains xx, yy, zz, 2 yz, 2 xz, 2 xy, and ww, the stretch of the membrane's thickness.
inline constexpr std::size_t uniform_strains = 7;

/// Second derivatives of the energy of a site of one layer by the strains, N m: divided by the
/// site's volume they are elastic constants.
using StrainEnergy = std::array<std::array<double, uniform_strains>, uniform_strains>;
StrainEnergy strain_energy(const InfiniteLattice& lattice);

/// Elastic constants of one layer whose height relaxes, Pa: strains xx, yy, zz, 2 yz, 2 xz, 2 xy
/// (Voigt).
using LayerStiffness = std::array<std::array<double, 6>, 6>;
LayerStiffness layer_stiffness(const InfiniteLattice& lattice, double site_volume);

/// Those of a cubic lattice along the axes; of any other, means over the axes.
ElasticConstants mean_constants(const LayerStiffness& stiffness);

}  // namespace hyperlattice
