// Where title, legend, scale bar and axes stand on a page: around the body, never on it.
#pragma once

#include "page.hpp"

#include <picture/camera.hpp>
#include <picture/colourings.hpp>

#include <optional>

namespace hyperlattice::render {

/// A colour with its meaning.
struct Key {
  Colour colour{};
  std::string text;
};

/// A colour map with numbers.
struct Scale {
  picture::ColourMap map = picture::ColourMap::viridis;
  picture::NumberRange range;
  double factor = 1;  ///< numbers shown are those of the range times this factor
  std::string name, unit;
};

struct Notes {
  std::string title, time;  ///< at the top
  std::string remark;       ///< below the body
  std::optional<Scale> scale;
  std::vector<Key> keys;  ///< below the scale
  bool has_scale_bar = false, has_axes = false;
};

class Layout {
 public:
  /// All lengths are pixels.
  Layout(int width, int height, const Notes& notes);

  /// Returns the part of the page that the body fills.
  picture::Frame frame() const;
  /// Returns the part of the page that the body may cover without touching the notes.
  picture::Frame body_area() const;
  /// Adds the notes to a page, which shows the body by this camera.
  void add_to(Page& page, const picture::Camera& camera) const;

 private:
  void add_heading(Page& page) const;
  void add_legend(Page& page) const;
  void add_scale(Page& page, double x, double& y) const;
  void add_scale_bar(Page& page, const picture::Camera& camera) const;
  void add_axes(Page& page, const picture::Camera& camera) const;
  std::vector<std::string> scale_texts() const;
  double legend_width() const;

  const Notes& notes_;
  double width_, height_;
  double font_;                            ///< size of the font
  double top_ = 0, right_ = 0, foot_ = 0;  ///< strips around the body
};

}  // namespace hyperlattice::render
