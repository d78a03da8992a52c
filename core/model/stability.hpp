// Stability of the infinite lattice over the whole Brillouin zone.
#pragma once

#include <model/strain_energy.hpp>

#include <optional>

namespace hyperlattice {

/// A deformation that releases energy and therefore grows.
struct Instability {
  bool homogeneous = false;  ///< true: a uniform strain; false: a wave
  /// If homogeneous: the part of each uniform strain.
  std::array<double, uniform_strains> strain{};
  Wave wave;  ///< if not homogeneous: the wave; its sector tells which lattice has it
};

/// Returns the deformation that grows in the mirrored layer (Sector::mirrored), or that grows only
/// in the full two-layer lattice (Sector::opposed); nothing if stable.
std::optional<Instability> find_instability(const InfiniteLattice& lattice, Sector sector);

/// Returns a sentence that names the deformation.
std::string describe(const Instability& instability);

}  // namespace hyperlattice
