// Which particles a picture shows.
#pragma once

#include <hyperlattice/output.hpp>

#include <optional>
#include <vector>

namespace hyperlattice::picture {

/// Returns the particles of a region without those of `cut`, in ascending order. Throws
/// std::runtime_error if none is left.
std::vector<Particle> drawn_particles(const OutputContext& context, RegionId region,
                                      const std::optional<RegionId>& cut);

}  // namespace hyperlattice::picture
