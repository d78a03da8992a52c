// The volumetric energies of the particles of a listed body (model/nodal_volumes.hpp) at given
// displacements, for outputs and for the distance from rest.
#pragma once

#include <model/nodal_volumes.hpp>
#include <state/breakage.hpp>

#include <span>
#include <vector>

namespace hyperlattice {

class PresentVolumes {
 public:
  /// `moved`: displacements of all particles, m. `breakages`: of the body so far. `volumes` must
  /// outlive the object.
  PresentVolumes(const NodalVolumes& volumes, std::vector<Vec3> moved,
                 std::span<const Breakage> breakages);

  double pressure(std::size_t particle) const { return now_.pressures[particle]; }  ///< Pa
  double energy(std::size_t particle) const { return now_.energies[particle]; }     ///< J
  /// Returns the derivative of the pressure by the volume of the particle, Pa / m3.
  double stiffness(std::size_t particle) const;
  Vec3 force(std::size_t particle) const {
    return volumes_.force(particle, now_.moved, now_.pressures);
  }  ///< N

 private:
  const NodalVolumes& volumes_;
  VolumeState now_;
};

}  // namespace hyperlattice
