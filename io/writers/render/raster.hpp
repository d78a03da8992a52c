// A drawn picture without its texts.
#pragma once

#include <cstdint>
#include <vector>

namespace hyperlattice::render {

struct Raster {
  int width = 0, height = 0;
  /// Row by row from the top, [y * width + x]: alpha, red, green and blue from the highest byte on,
  /// each colour times alpha.
  std::vector<std::uint32_t> pixels;
};

}  // namespace hyperlattice::render
