// Pictures drawn by gnuplot.
#pragma once

#include <filesystem>
#include <string>

namespace hyperlattice {

/// Runs gnuplot on the commands and writes what they plot to an SVG file, which is whole or not there. OutsideError if gnuplot is not installed
/// or fails, or if the file cannot be written.
void draw_svg(const std::filesystem::path& file, const std::string& commands, int width = 760, int height = 760);

}  // namespace hyperlattice
