// An image in memory.
#pragma once

#include <picture/palette.hpp>

#include <vector>

namespace hyperlattice::picture {

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
