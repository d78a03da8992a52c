// PNG files.
#pragma once

#include "image.hpp"

#include <string>
#include <utility>

namespace hyperlattice::picture {

/// Keyword and text, stored in the file for whoever asks what it shows.
using Notes = std::vector<std::pair<std::string, std::string>>;

/// The bytes of a PNG file. Throws std::runtime_error if libpng refuses.
std::string encode_png(const Image& image, const Notes& notes);

}  // namespace hyperlattice::picture
