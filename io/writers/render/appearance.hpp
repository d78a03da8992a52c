// The colours of the particles in a frame, and what the legend tells about them.
#pragma once

#include "layout.hpp"
#include "options.hpp"

namespace hyperlattice::render {

struct Appearance {
  std::vector<Colour> particles;  ///< of all particles
  std::optional<Scale> scale;
  std::vector<Key> keys;
};

inline constexpr Colour crack_colour{40, 40, 40};

/// The colours of broken springs.
Colour open_colour(const Options& options);
Colour closed_colour(const Options& options);

/// Returns the colours by failure, or by the quantity that the options name. The range is that of
/// the options, or of the drawn particles.
Appearance appearance_of(const Snapshot& snapshot, const Options& options,
                         std::string_view colour_by, const std::vector<bool>& is_drawn);

}  // namespace hyperlattice::render
