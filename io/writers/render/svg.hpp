// Pages as SVG. Cairo would draw each glyph as a shape; here texts stay texts, so that they can be
// searched and edited.
#pragma once

#include "page.hpp"

namespace hyperlattice::render {

/// Returns the SVG file of a page. `png`: its raster as a PNG file.
std::string svg_of(const Page& page, std::string_view png);

}  // namespace hyperlattice::render
