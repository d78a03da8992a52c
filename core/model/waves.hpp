// Waves of the infinite lattice, of one layer with its mirror image and of the full membrane of two
// layers. Mirroring splits the 8 x 8 dynamical matrix of the full lattice in two: waves that the
// mirror maps onto themselves (the only ones of the mirrored layer), and waves that it reverses.
#pragma once

#include <model/model.hpp>

namespace hyperlattice {

/// The infinite lattice of one material.
struct InfiniteLattice {
  std::span<const NeighbourGeometry> neighbours;
  std::span<const SpringConstants> springs;  ///< one for each spring class
  double alpha = 0;                          ///< k_alpha, N/m
  double membrane_distance = 0;              ///< Delta, metres
  KernelChoice::Membrane membrane = KernelChoice::Membrane::none;
  double spacing = 0;         ///< metres
  Basis basis = cubic_basis;  ///< in units of the spacing
  double volumetric = 0;      ///< K_v of its cells, Pa
};

enum class Sector {
  mirrored,  ///< the layers move alike in space and oppositely in the fourth dimension
  opposed    ///< the layers move oppositely in space and alike in the fourth dimension; only the
             ///< two-layer lattice has these waves
};

/// A lattice wave u = a cos(q . x / l + phase), l the spacing.
struct Wave {
  Vec3 vector;           ///< q, radians per spacing
  double stiffness = 0;  ///< m omega^2, N/m; if negative, the wave grows
  Vec3 direction;        ///< direction of the motion in space
  double height = 0;     ///< component of the motion in the fourth dimension; direction and height
                         ///< together have length 1
  Sector sector = Sector::mirrored;
};

/// Returns all waves of wave vector q (radians per spacing), the softest first: three, or four if
/// the membrane is free.
std::vector<Wave> waves(const InfiniteLattice& lattice, Vec3 q, Sector sector);

/// Smallest and largest m omega^2, N/m, of the waves of one wave vector.
struct StiffnessRange {
  double softest = 0, stiffest = 0;
};
StiffnessRange stiffness_range(const InfiniteLattice& lattice, Vec3 q, Sector sector);

/// Returns the stiffest wave of the mirrored layer in the whole Brillouin zone: omega_max^2 =
/// stiffness / m.
Wave stiffest_wave(const InfiniteLattice& lattice);

/// Returns for example "the wave with vector (pi, 0, 0) a spacing, moving along (1, 0, 0)".
std::string describe(const Wave& wave);

}  // namespace hyperlattice
