// An image in memory.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace hyperlattice::picture {

using Colour = std::array<std::uint8_t, 3>;  ///< red, green, blue, 0 to 255, as on a screen

struct Image {
  Image(int w, int h)
      : width(w),
        height(h),
        pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), Colour{255, 255, 255}) {}
  Colour& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }

  int width, height;
  std::vector<Colour> pixels;  ///< row by row from the top, [y * width + x]
};

}  // namespace hyperlattice::picture
