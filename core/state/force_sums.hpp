// The sums of forces that probes follow.
#pragma once

#include <state/external_forces.hpp>
#include <state/section_forces.hpp>
#include <state/sweeps.hpp>

#include <cstddef>
#include <span>
#include <variant>
#include <vector>

namespace hyperlattice {

/// Nothing of it is saved in a checkpoint: a resumed run asks for its sums again.
class ForceSums {
 public:
  ForceSums(const BlockSet& blocks, const Clock& clock, const ActingLoads& loads,
            NodalPressures& pressures, const DamageField& damage, Sweeps& sweeps)
      : blocks_(blocks),
        clock_(clock),
        loads_(loads),
        pressures_(pressures),
        damage_(damage),
        sweeps_(sweeps) {}

  /// Begins to follow the force through a section.
  ForcesId follow(const PlaneSection& section);
  /// Begins to follow the forces of a load.
  ForcesId follow(std::size_t load);
  /// Begins to follow the forces of all loads on these particles, which are ascending.
  ForcesId follow(std::span<const Particle> particles);

  std::size_t size() const { return all_.size(); }
  /// Evaluates the forces of loads in the present state. It costs one sweep that changes nothing
  /// else, if any of them is followed.
  void measure();
  /// Returns the resultant with the moment about a point, m. `forces`: from follow(). Forces of
  /// loads are those of the last measure().
  Resultant sum(ForcesId forces, Vec3 about) const;

 private:
  using Followed = std::variant<SectionForces, ExternalForces>;
  ForcesId add(Followed followed);

  const BlockSet& blocks_;
  const Clock& clock_;
  const ActingLoads& loads_;
  NodalPressures& pressures_;
  const DamageField& damage_;
  Sweeps& sweeps_;
  std::vector<Followed> all_;
};

}  // namespace hyperlattice
