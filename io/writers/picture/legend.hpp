// Text and keys that explain a picture's colours.
#pragma once

#include "image.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice::picture {

/// Height in pixels of the strip at an image's foot that a legend needs.
int legend_height(int width);

/// Writes at (x, y), the text's top left corner: small letters, digits and "-+.=/()"; others are
/// blank. Returns where the text ends.
int write_text(Image& image, int x, int y, std::string_view text);

struct Key {
  Colour colour;
  std::string text;
};
/// Coloured squares with their meaning, at the foot.
void draw_keys(Image& image, const std::vector<Key>& keys);

/// The strip of the colour map with its ends and the quantity's name, at the foot.
void draw_scale(Image& image, std::string_view low, std::string_view high,
                std::string_view quantity);

}  // namespace hyperlattice::picture
