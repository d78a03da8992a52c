// A page of a picture: the drawn body with texts, lines and boxes around it. It becomes a PNG, PDF
// or SVG file, by Cairo besides the texts of SVG.
#pragma once

#include "raster.hpp"

#include <picture/palette.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice::render {

using picture::Colour;

/// All lengths are pixels of the raster, from the top left corner of the page.
struct PageText {
  double x = 0, y = 0;  ///< the point on the base line that `anchor` names
  double size = 0;      ///< of the font
  double anchor = 0;    ///< 0: the text begins there; 0.5: its middle; 1: it ends there
  std::string text;     ///< UTF-8
  bool is_bold = false;
};
struct PageLine {
  double x1 = 0, y1 = 0, x2 = 0, y2 = 0, width = 1;
};
struct PageBox {
  double x = 0, y = 0, width = 0, height = 0;
  Colour colour{};
};

struct Page {
  const Raster* raster = nullptr;  ///< fills the page
  bool is_transparent = false;     ///< the background of the page; else white
  std::string title;               ///< of the file, for PDF
  std::vector<PageBox> boxes;      ///< drawn first
  std::vector<PageLine> lines;
  std::vector<PageText> texts;
};

/// The colour of texts and lines.
inline constexpr Colour ink{30, 30, 30};

/// Returns the width of a text in the font of the pages, pixels.
double text_width(std::string_view text, double size, bool is_bold = false);

enum class Format : std::uint32_t { png, svg, pdf };
inline constexpr std::string_view format_names[] = {"png", "svg", "pdf"};

/// Returns the bytes of the file. The texts of PDF and SVG stay texts; the body is a picture in
/// them. Throws std::runtime_error if Cairo fails, std::bad_alloc if it gets no memory.
std::string encode(const Page& page, Format format);

}  // namespace hyperlattice::render
