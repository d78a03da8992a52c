// The kinetic energy of a body, found without a sweep.
#pragma once

#include <state/block_set.hpp>

#include <vector>

namespace hyperlattice {

class KineticEnergy {
 public:
  explicit KineticEnergy(const BlockSet& blocks) : blocks_(blocks) {}

  /// Returns the kinetic energy, J, of the present velocities v(n-1/2). The result has the same
  /// bits for any number of blocks.
  double now();

 private:
  const BlockSet& blocks_;
  std::vector<double> masses_;  // of all particles, kg; filled by the first call
};

}  // namespace hyperlattice
