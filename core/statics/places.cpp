// The places of the particles of a region, for solvers that follow what a part of the body does.
#include <model/region_index.hpp>
#include <statics/statics.hpp>

namespace hyperlattice {

std::span<const std::int64_t> Statics::places_in(RegionId region) {
  const auto [found, is_new] = places_in_.try_emplace(region.index);
  if (is_new) {
    RegionIndex regions(model_.body, model_.scene->regions);
    for (const Particle particle : regions.particles(region))
      found->second.push_back(place_of(particle));
  }
  return found->second;
}

}  // namespace hyperlattice
