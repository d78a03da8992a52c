// PNG files as pixels.
#pragma once

#include <gtest/gtest.h>
#include <png.h>

#include <string>
#include <vector>

namespace hyperlattice::test {

struct Pixels {
  int width = 0, height = 0;
  std::vector<png_byte> rgb;
  const png_byte* at(int x, int y) const {
    return &rgb[3 * static_cast<std::size_t>(y * width + x)];
  }
};

inline Pixels read_png(const std::string& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_TRUE(png_image_begin_read_from_file(&image, path.c_str())) << image.message;
  image.format = PNG_FORMAT_RGB;
  Pixels pixels{static_cast<int>(image.width), static_cast<int>(image.height),
                std::vector<png_byte>(PNG_IMAGE_SIZE(image))};
  EXPECT_TRUE(png_image_finish_read(&image, nullptr, pixels.rgb.data(), 0, nullptr))
      << image.message;
  return pixels;
}

}  // namespace hyperlattice::test
