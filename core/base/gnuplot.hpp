// Pictures drawn by gnuplot.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>

namespace hyperlattice {

/// Runs gnuplot on the commands, and returns what they plot, as SVG. No shell and no start-up file
/// of the user has a part in it. OutsideError, which names the `file` that it is for, if gnuplot is
/// not installed, fails or takes longer than `patience`.
std::string svg_picture(const std::filesystem::path& file, const std::string& commands,
                        int width = 760, int height = 760,
                        std::chrono::milliseconds patience = std::chrono::seconds(60));

/// The same into a file, which is whole or not there. OutsideError if it cannot be written, or if
/// no regular file stands there.
void draw_svg(const std::filesystem::path& file, const std::string& commands, int width = 760,
              int height = 760, std::chrono::milliseconds patience = std::chrono::seconds(60));

/// A text as gnuplot's commands take it: drawn as it stands, whatever it holds, where the command
/// says `noenhanced`. Lines stay apart; other control characters become blanks, and what is no
/// UTF-8 becomes U+FFFD.
std::string gnuplot_text(std::string_view text);

}  // namespace hyperlattice
