// Elasticity of an endless lattice from its neighbours alone: equations (24) to (32) of Zhao 2017,
// summed over the springs, whatever the lattice.
#pragma once

#include <model/spring_lattice.hpp>
#include <model/strain_energy.hpp>

namespace hyperlattice {

/// For a lattice that is not cubic, C1 to C4 and C11, C12, C44 are means over the axes, and
/// `stiffness` says the rest.
struct LatticeElasticity {
  double C1 = 0, C2 = 0, C3 = 0,
         C4 = 0;             ///< of both layers, xxxx, xxyy, wwww, xxww: over k l^2 / (V Delta)
  LayerStiffness stiffness;  ///< of one layer, its height relaxed: over k / l
  double C11 = 0, C12 = 0, C44 = 0;  ///< over k / l
  bool cubic = false;                ///< three constants say it all
  bool isotropic = false;            ///< two do

  double young() const {
    return (C11 - C12) * (C11 + 2 * C12) / (C11 + C12);
  }  ///< E l / k along [100]
  double poisson_bulk() const {
    return C12 / (C11 + C12);
  }  ///< nu', equation (21): pull along [100]
  double poisson_shear() const {
    return (2 * C44 - C11) / (2 * C44 - 2 * C11);
  }                                                       ///< nu'', equation (22)
  double zener() const { return 2 * C44 / (C11 - C12); }  ///< A: 1 if isotropic
};

LatticeElasticity elasticity(const SpringLattice& lattice);

}  // namespace hyperlattice
