#include "page.hpp"

#include "cairo_handles.hpp"
#include "svg.hpp"

#include <cairo-pdf.h>

namespace hyperlattice::render {

namespace {

constexpr double points_per_pixel = 0.48;  ///< 150 pixels an inch

void set_font(cairo_t* context, double size, bool is_bold) {
  cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         is_bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, size);
  cairo_font_options_t* const options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context, options);
  cairo_font_options_destroy(options);
}

double width_of(cairo_t* context, std::string_view text) {
  cairo_text_extents_t extents;
  cairo_text_extents(context, std::string(text).c_str(), &extents);
  check(cairo_status(context));
  return extents.x_advance;
}

void set_colour(cairo_t* context, Colour colour) {
  cairo_set_source_rgb(context, colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0);
}

/// Returns a surface on the pixels of a raster, which must outlive it.
CairoSurface surface_of(const Raster& raster) {
  // Cairo does not change the pixels of a source.
  auto* const bytes =
      reinterpret_cast<unsigned char*>(const_cast<std::uint32_t*>(raster.pixels.data()));
  CairoSurface surface(cairo_image_surface_create_for_data(bytes, CAIRO_FORMAT_ARGB32, raster.width,
                                                           raster.height, 4 * raster.width));
  check(cairo_surface_status(surface.get()));
  return surface;
}

void draw(const Page& page, cairo_t* context) {
  if (!page.is_transparent) {
    cairo_set_source_rgb(context, 1, 1, 1);
    cairo_paint(context);
  }
  const CairoSurface raster = surface_of(*page.raster);
  cairo_set_source_surface(context, raster.get(), 0, 0);
  cairo_paint(context);
  for (const PageBox& box : page.boxes) {
    set_colour(context, box.colour);
    cairo_rectangle(context, box.x, box.y, box.width, box.height);
    cairo_fill(context);
  }
  set_colour(context, ink);
  for (const PageLine& line : page.lines) {
    cairo_set_line_width(context, line.width);
    cairo_move_to(context, line.x1, line.y1);
    cairo_line_to(context, line.x2, line.y2);
    cairo_stroke(context);
  }
  for (const PageText& text : page.texts) {
    set_font(context, text.size, text.is_bold);
    const double width = text.anchor == 0 ? 0 : width_of(context, text.text);
    cairo_move_to(context, text.x - text.anchor * width, text.y);
    cairo_show_text(context, text.text.c_str());
  }
  check(cairo_status(context));
}

std::string png_of(cairo_surface_t* surface) {
  std::string bytes;
  check(cairo_surface_write_to_png_stream(surface, append_bytes, &bytes));
  return bytes;
}

std::string encode_png(const Page& page) {
  const CairoSurface surface(
      cairo_image_surface_create(page.is_transparent ? CAIRO_FORMAT_ARGB32 : CAIRO_FORMAT_RGB24,
                                 page.raster->width, page.raster->height));
  check(cairo_surface_status(surface.get()));
  draw(page, CairoContext(cairo_create(surface.get())).get());
  return png_of(surface.get());
}

std::string encode_pdf(const Page& page) {
  std::string bytes;
  const CairoSurface surface(cairo_pdf_surface_create_for_stream(
      append_bytes, &bytes, points_per_pixel * page.raster->width,
      points_per_pixel * page.raster->height));
  check(cairo_surface_status(surface.get()));
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, page.title.c_str());
  // A fixed date, so that the same run writes the same bytes.
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE,
                                 "2000-01-01T00:00:00Z");
  {
    const CairoContext context(cairo_create(surface.get()));
    cairo_scale(context.get(), points_per_pixel, points_per_pixel);
    draw(page, context.get());
  }
  cairo_surface_finish(surface.get());
  check(cairo_surface_status(surface.get()));
  return bytes;
}

}  // namespace

double text_width(std::string_view text, double size, bool is_bold) {
  const CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
  const CairoContext context(cairo_create(surface.get()));
  set_font(context.get(), size, is_bold);
  return width_of(context.get(), text);
}

std::string encode(const Page& page, Format format) {
  switch (format) {
    case Format::pdf:
      return encode_pdf(page);
    case Format::svg:
      return svg_of(page, png_of(surface_of(*page.raster).get()));
    default:
      return encode_png(page);
  }
}

}  // namespace hyperlattice::render
