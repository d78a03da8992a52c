// Encodes images as PNG files by libpng.
#pragma once

#include "image.hpp"

#include <string>
#include <utility>

namespace hyperlattice::picture {

/// Keywords and texts that the file stores as its description.
using Notes = std::vector<std::pair<std::string, std::string>>;

/// Returns the bytes of a PNG file. Throws std::runtime_error if libpng fails.
std::string encode_png(const Image& image, const Notes& notes);

}  // namespace hyperlattice::picture
