#include "svg.hpp"

#include <hyperlattice/files.hpp>

namespace hyperlattice::render {

namespace {

std::string base64(std::string_view bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(bytes.size() / 3 * 4 + 4);
  for (std::size_t n = 0; n < bytes.size(); n += 3) {
    std::uint32_t group = 0;
    for (std::size_t byte = 0; byte < 3; ++byte)
      group =
          group << 8 | (n + byte < bytes.size() ? static_cast<unsigned char>(bytes[n + byte]) : 0U);
    for (std::size_t digit = 0; digit < 4; ++digit)
      text += n + digit > bytes.size() ? '=' : digits[group >> (18 - 6 * digit) & 63];
  }
  return text;
}

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else
      safe += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return safe;
}

std::string rgb(Colour colour) {
  return "rgb(" + std::to_string(colour[0]) + "," + std::to_string(colour[1]) + "," +
         std::to_string(colour[2]) + ")";
}

std::string attribute(std::string_view name, double value) {
  std::string text = " " + std::string(name) + "=\"";
  return text + short_number(value) + "\"";
}

}  // namespace

std::string svg_of(const Page& page, std::string_view png) {
  const std::string width = std::to_string(page.raster->width),
                    height = std::to_string(page.raster->height);
  std::string svg =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
      "xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"" +
      width + "\" height=\"" + height + "\" viewBox=\"0 0 " + width + " " + height +
      "\">\n<title>" + escaped(page.title) + "</title>\n";
  if (!page.is_transparent)
    svg += "<rect width=\"" + width + "\" height=\"" + height + "\" fill=\"white\"/>\n";
  svg += "<image width=\"" + width + "\" height=\"" + height +
         "\" xlink:href=\"data:image/png;base64," + base64(png) + "\"/>\n";
  for (const PageBox& box : page.boxes)
    svg += "<rect" + attribute("x", box.x) + attribute("y", box.y) + attribute("width", box.width) +
           attribute("height", box.height) + " fill=\"" + rgb(box.colour) + "\"/>\n";
  svg += "<g stroke=\"" + rgb(ink) + "\">\n";
  for (const PageLine& line : page.lines)
    svg += "<line" + attribute("x1", line.x1) + attribute("y1", line.y1) +
           attribute("x2", line.x2) + attribute("y2", line.y2) +
           attribute("stroke-width", line.width) + "/>\n";
  svg += "</g>\n<g font-family=\"DejaVu Sans, Verdana, sans-serif\" fill=\"" + rgb(ink) + "\">\n";
  for (const PageText& text : page.texts)
    svg += "<text" + attribute("x", text.x) + attribute("y", text.y) +
           attribute("font-size", text.size) + (text.is_bold ? " font-weight=\"bold\"" : "") +
           (text.anchor == 0     ? ""
            : text.anchor == 0.5 ? " text-anchor=\"middle\""
                                 : " text-anchor=\"end\"") +
           ">" + escaped(text.text) + "</text>\n";
  return svg + "</g>\n</svg>\n";
}

}  // namespace hyperlattice::render
