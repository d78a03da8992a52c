// The waves of the endless lattice, of one layer under its mirror and of the full membrane of two
// layers. Mirroring splits the full lattice's 8 x 8 dynamical matrix in two: waves that the mirror
// maps onto themselves (all that the mirrored layer can do), and waves that it reverses.
#pragma once

#include <model/model.hpp>

namespace hyperlattice {

/// The endless lattice of one material.
struct InfiniteLattice {
  std::span<const NeighbourGeometry> neighbours;
  std::span<const SpringConstants> springs;  ///< one a spring class
  double alpha = 0;                          ///< k_alpha, N/m
  double membrane_distance = 0;              ///< Delta, metres
  KernelChoice::Membrane membrane = KernelChoice::Membrane::none;
  double spacing = 0;         ///< metres
  Basis basis = cubic_basis;  ///< in units of the spacing
};

enum class Sector {
  mirrored,  ///< the layers move alike in space and oppositely in the fourth dimension
  opposed    ///< the layers move oppositely in space and alike in the fourth dimension; only the
             ///< two-layer lattice can
};

/// A lattice wave u = a cos(q . x / l + phase), l the spacing.
struct Wave {
  Vec3 vector;           ///< q, radians a spacing
  double stiffness = 0;  ///< m omega^2, N/m; negative: the wave grows
  Vec3 direction;        ///< of the motion in space
  double height = 0;     ///< share of the motion in the fourth dimension; direction and height
                         ///< together have length 1
  Sector sector = Sector::mirrored;
};

/// All waves of vector q (radians a spacing), the softest first: three, or four if the membrane
/// moves in the fourth dimension.
std::vector<Wave> waves(const InfiniteLattice& lattice, Vec3 q, Sector sector);

/// m omega^2 of the softest and of the stiffest of them.
struct StiffnessRange {
  double softest = 0, stiffest = 0;
};
StiffnessRange stiffness_range(const InfiniteLattice& lattice, Vec3 q, Sector sector);

/// The stiffest wave of the mirrored layer in the whole Brillouin zone: omega_max^2 = stiffness /
/// m.
Wave stiffest_wave(const InfiniteLattice& lattice);

/// "the wave with vector (pi, 0, 0) a spacing, moving along (1, 0, 0)"
std::string describe(const Wave& wave);

}  // namespace hyperlattice
