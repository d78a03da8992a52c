// Pictures drawn by gnuplot.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>

namespace hyperlattice {

/// Runs gnuplot on the commands and writes what they plot to an SVG file, which is whole or not there. No shell and no start-up file of the user has
/// a part in it. OutsideError if gnuplot is not installed, fails or takes longer than `patience`, or if the file cannot be written.
void draw_svg(const std::filesystem::path& file, const std::string& commands, int width = 760, int height = 760,
              std::chrono::milliseconds patience = std::chrono::seconds(60));

/// A text as gnuplot's commands take it: drawn as it stands, whatever it holds, where the command says `noenhanced`. Lines stay apart; other control
/// characters become blanks, and what is no UTF-8 becomes U+FFFD.
std::string gnuplot_text(std::string_view text);

}  // namespace hyperlattice
