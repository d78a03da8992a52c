// The colours of pictures: three for the state of failure, and the colour map viridis for numbers,
// which is perceptually uniform and readable for the colour-blind.
#pragma once

#include "image.hpp"

#include <algorithm>
#include <cmath>

namespace hyperlattice::picture {

inline constexpr Colour intact{70, 118, 190}, open_failure{214, 48, 38},
    closed_failure{58, 168, 76};
/// The colour of a particle without a value.
inline constexpr Colour no_value{196, 196, 196};

/// Returns the colour of the map viridis at `share` in [0, 1], interpolated between eleven samples.
/// Numbers outside [0, 1] are clamped; `share` must be a number.
inline Colour viridis(double share) {
  constexpr double samples[11][3] = {{.267, .005, .329}, {.283, .141, .458}, {.254, .265, .530},
                                     {.207, .372, .553}, {.164, .471, .558}, {.128, .567, .551},
                                     {.135, .659, .518}, {.267, .749, .441}, {.478, .821, .318},
                                     {.741, .873, .150}, {.993, .906, .144}};
  const double place = 10 * std::clamp(share, 0.0, 1.0);
  const auto below = static_cast<std::size_t>(std::min(place, 9.0));
  Colour colour{};
  for (std::size_t n = 0; n < 3; ++n)
    colour[n] = static_cast<std::uint8_t>(
        std::lround(255 * std::lerp(samples[below][n], samples[below + 1][n],
                                    place - static_cast<double>(below))));
  return colour;
}

}  // namespace hyperlattice::picture
