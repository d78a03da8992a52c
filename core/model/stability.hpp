// Stability of the endless lattice over the whole Brillouin zone.
#pragma once

#include <model/strain_energy.hpp>

#include <optional>

namespace hyperlattice {

/// What releases energy and so grows by itself.
struct Instability {
  bool homogeneous = false;                      ///< a uniform strain; else a wave
  std::array<double, uniform_strains> strain{};  ///< homogeneous: the share of each
  Wave wave;  ///< if not homogeneous; its sector says which lattice has it
};

/// What grows in the mirrored layer (Sector::mirrored), or in the full two-layer lattice besides
/// that (Sector::opposed); nothing if stable.
std::optional<Instability> find_instability(const InfiniteLattice& lattice, Sector sector);

/// A sentence that names what grows.
std::string describe(const Instability& instability);

}  // namespace hyperlattice
