// Elasticity of an infinite lattice from its neighbours: the sums over springs behind equations
// (24) to (32) of Zhao 2017, for any lattice.
#pragma once

#include <model/spring_lattice.hpp>
#include <model/strain_energy.hpp>

namespace hyperlattice {

/// Elastic constants of a lattice. If it is not cubic, C1 to C4 and C11, C12, C44 are means over
/// the axes, and `stiffness` has the full matrix.
struct LatticeElasticity {
  /// Both layers: xxxx, xxyy, wwww, xxww, over k l^2 / (V Delta).
  double C1 = 0, C2 = 0, C3 = 0, C4 = 0;
  LayerStiffness stiffness;          ///< one layer with relaxed height, over k / l
  double C11 = 0, C12 = 0, C44 = 0;  ///< over k / l
  bool cubic = false;                ///< three constants suffice
  bool isotropic = false;            ///< two constants suffice

  /// E l / k along [100].
  double young() const { return (C11 - C12) * (C11 + 2 * C12) / (C11 + C12); }
  /// nu', equation (21): uniaxial stress along [100].
  double poisson_bulk() const { return C12 / (C11 + C12); }
  /// nu'', equation (22).
  double poisson_shear() const { return (2 * C44 - C11) / (2 * C44 - 2 * C11); }
  double zener() const { return 2 * C44 / (C11 - C12); }  ///< A: 1 if isotropic
};

/// Computes the elastic constants of a lattice.
LatticeElasticity elasticity(const SpringLattice& lattice);

}  // namespace hyperlattice
