// Text and legends that explain the colours of a picture.
#pragma once

#include "image.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice::picture {

/// Returns the height of a legend at the bottom of an image of the given width, pixels.
int legend_height(int width);

/// Writes a text with its top left corner at (x, y), pixels. Small letters, digits and "-+.=/()"
/// are drawn; other characters are blank. Returns the x of the text's end.
int write_text(Image& image, int x, int y, std::string_view text);

struct Key {
  Colour colour;
  std::string text;
};
/// Draws coloured squares with their texts at the bottom of the image.
void draw_keys(Image& image, const std::vector<Key>& keys);

/// Draws the colour map with the values at its ends and the name of the quantity at the bottom of
/// the image.
void draw_scale(Image& image, std::string_view low, std::string_view high,
                std::string_view quantity);

}  // namespace hyperlattice::picture
