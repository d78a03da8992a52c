// The colours of pictures: three for the state of failure, and colour maps for numbers, which are
// readable for the colour-blind.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace hyperlattice::picture {

using Colour = std::array<std::uint8_t, 3>;  ///< red, green, blue, 0 to 255, as on a screen

inline constexpr Colour intact{70, 118, 190}, open_failure{214, 48, 38},
    closed_failure{58, 168, 76};
/// The colour of a particle without a value.
inline constexpr Colour no_value{196, 196, 196};

enum class ColourMap : std::uint32_t { viridis, cividis, inferno, blue_red, grey };
inline constexpr std::string_view colour_map_names[] = {"viridis", "cividis", "inferno", "blue_red",
                                                        "grey"};

/// Returns the colour of a map at `share` in [0, 1], interpolated between samples. Numbers outside
/// [0, 1] are clamped; `share` must be a number. Viridis, cividis and inferno are perceptually
/// uniform (Smith and van der Walt 2015; Nunez et al. 2018); blue_red, for numbers of both signs,
/// is RdBu of ColorBrewer.
Colour colour_of(ColourMap map, double share);

/// Returns the colour of the map viridis.
inline Colour viridis(double share) { return colour_of(ColourMap::viridis, share); }

}  // namespace hyperlattice::picture
