// The particles on which loads act, alone or together in a region.
#pragma once

#include <model/model.hpp>
#include <model/region_index.hpp>

#include <map>
#include <span>
#include <vector>

namespace hyperlattice {

/// Finds the particles of each load when it is first asked for.
class ActedParticles {
 public:
  ActedParticles(const Model& model, RegionIndex& regions) : model_(model), regions_(regions) {}

  /// Returns the particles of the region, or those on which the load acts, ascending. Throws
  /// PluginMistake if there is no such load or region.
  std::span<const Particle> particles(LoadOrRegion of);

 private:
  const Model& model_;
  RegionIndex& regions_;
  std::map<std::size_t, std::vector<Particle>> of_load_;
};

}  // namespace hyperlattice
