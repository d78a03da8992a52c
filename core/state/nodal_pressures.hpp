// The volumetric energies of the particles of a listed body (model/nodal_volumes.hpp) in the
// present state. The energy of a particle ends when one of its springs breaks, or one that is an
// edge of one of its tetrahedra: then no energy is created, whatever the volumes of the others.
#pragma once

#include <model/nodal_volumes.hpp>
#include <state/block_set.hpp>

#include <vector>

namespace hyperlattice {

class NodalPressures {
 public:
  explicit NodalPressures(const BlockSet& blocks);

  /// Returns the memory of the object, bytes.
  static double bytes(const NodalVolumes& volumes);

  /// Returns whether no particle has a volumetric energy. All other functions need one.
  bool empty() const { return volumes_ == nullptr; }
  /// Finds the pressures of the present displacements. The sums have the same order for any number
  /// of threads.
  void update();
  /// Returns the force on a particle in the state of the last update, N.
  Vec3 force(Particle particle) const {
    return volumes_->force(particle, now_.moved, now_.pressures);
  }
  /// Returns the forces of a tetrahedron on its corners in that state, N.
  std::array<Vec3, 4> forces(std::size_t tetrahedron) const;
  /// Returns the energy of a particle, J, in that state.
  double energy(Particle particle) const { return now_.energies[particle]; }
  /// Returns the particle at the start of a row of a block.
  Particle first_of(const Block& block, const Row& row) const {
    return first_[block.number] + row.start;
  }

  /// Ends the energies that end with the spring from a to b, see NodalVolumes::for_ended_by.
  /// Returns the energy that is lost, J, with half of the work of the last step of length `step`,
  /// s, as FailureRecord counts it for springs. Must be called after the step, by one thread.
  double lose(Particle a, Particle b, double step);

 private:
  double energy_before(Particle particle, double step) const;
  template <class Work>
  void for_pieces(std::size_t size, const Work& work) const;

  const BlockSet& blocks_;
  const NodalVolumes* volumes_;
  std::vector<Particle> first_;  ///< of each block
  VolumeState now_;              ///< of the last update
};

}  // namespace hyperlattice
