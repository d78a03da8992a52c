// Pictures drawn by gnuplot, in a process of its own.
#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>

namespace hyperlattice {

/// The colours of the curves of a plot, in their order.
inline constexpr std::array<const char*, 12> plot_colours{
    "#1b6ca8", "#e67e22", "#27825a", "#8e44ad", "#b03a2e", "#7f6000",
    "#2e86c1", "#7f8c8d", "#c2185b", "#00796b", "#5d4037", "#9e9d24"};

/// Runs gnuplot on the commands and returns the picture as SVG, `width` x `height` pixels. Texts
/// are UTF-8, and ticks point outwards. Uses no shell and no start-up file of the user. Throws
/// OutsideError with the name of `file` if gnuplot is not installed, fails or takes longer than
/// `patience`.
std::string svg_picture(const std::filesystem::path& file, const std::string& commands,
                        int width = 760, int height = 760,
                        std::chrono::milliseconds patience = std::chrono::seconds(60));

/// Draws into a file; after an error no partial file is left. Throws OutsideError also if the file
/// cannot be written or is not a regular file.
void draw_svg(const std::filesystem::path& file, const std::string& commands, int width = 760,
              int height = 760, std::chrono::milliseconds patience = std::chrono::seconds(60));

/// Returns a text quoted for gnuplot's commands; with `noenhanced` gnuplot draws it unchanged. Line
/// ends stay; other control characters become blanks, and bytes that are not UTF-8 become U+FFFD.
std::string gnuplot_text(std::string_view text);

}  // namespace hyperlattice
