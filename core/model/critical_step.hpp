// Stability and the critical time step of central differences, 2 / omega_max, from the lattice's waves.
#pragma once

#include <model/model.hpp>

#include <optional>

namespace hyperlattice {

/// The endless lattice of one material, in its mirrored single layer.
struct InfiniteLattice {
  std::span<const NeighbourGeometry> neighbours;
  std::span<const SpringConstants> springs;  ///< one a spring class
  double alpha = 0;                          ///< k_alpha, N/m
  double membrane_distance = 0;              ///< Delta, metres
  KernelChoice::Membrane membrane = KernelChoice::Membrane::none;
};

/// A lattice wave u = a cos(q . n + phase), n counted in sites.
struct Wave {
  Vec3 vector;           ///< q, radians a site
  double stiffness = 0;  ///< m omega^2, N/m; negative: the wave grows
  Vec3 direction;        ///< of the motion in space
  double height = 0;     ///< share of the motion in the fourth dimension; direction and height together have length 1
};

/// The stiffest wave of the whole Brillouin zone: omega_max^2 = stiffness / m.
Wave stiffest_wave(const InfiniteLattice& lattice);

/// A sentence that names what grows by itself, a homogeneous deformation or a wave; nothing if the lattice is stable.
std::optional<std::string> instability(const InfiniteLattice& lattice);

/// Bound of m omega^2 for any body of springs: twice the largest eigenvalue of the sum of |k| n n^T over the springs of a particle,
/// n in four dimensions. It holds because (n.a - n.b)^2 <= 2 (n.a)^2 + 2 (n.b)^2 for every spring.
class StiffnessBound {
 public:
  /// Adds the springs from the particle to a neighbour: side 1, or to the one on the opposite side: side -1.
  void add(const NeighbourGeometry& neighbour, int side, const SpringConstants& spring, double membrane_distance, KernelChoice::Membrane membrane);
  void add_alpha(double alpha);  ///< N/m
  double value() const;          ///< N/m

 private:
  double sum_[10] = {};  // lower triangle of the 4 x 4 matrix, by rows
};

/// "the wave (pi, 0, 0) a site, moving along (1, 0, 0)"
std::string describe(const Wave& wave);

/// Sets the model's critical time step and what limits it: exact for one material, a safe bound for several. A fault for each unstable material.
void find_critical_step(Model& model, Faults& faults);

}  // namespace hyperlattice
