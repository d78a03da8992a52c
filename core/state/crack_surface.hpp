// How much crack there is: the energy and the area of the cracks of cohesive materials.
#pragma once

namespace hyperlattice {

struct CrackSurface {
  /// Energy of the surfaces, J: sum over the particles of V u (d - d^2 / 2 + b^2 |grad d|^2 / 2),
  /// with u = 2 G_i / (pi b). The rest of what failure dissipated is viscous, or moves d.
  double energy = 0;
  double area = 0;  ///< m2: of each material its energy over G_i
};

}  // namespace hyperlattice
