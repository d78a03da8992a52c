#include "layout.hpp"

#include "prefixes.hpp"

#include <hyperlattice/files.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace hyperlattice::render {

namespace {

// Lengths in sizes of the font.
constexpr double bar_width = 1.3, gap = 0.5, title_size = 1.2, line = 1.5, axes_size = 2.2;
constexpr double smallest_title = 0.6;  ///< of its size
constexpr int most_ticks = 7;

/// The numbers at a scale; a range that is a point has one.
std::vector<double> marks(const Scale& scale) {
  return ticks(scale.factor * scale.range.low, scale.factor * scale.range.high, most_ticks);
}

/// Drops the last character of a UTF-8 text, whole or not, unless the character has one byte.
void drop_last_of_many_bytes(std::string& text) {
  const auto has = [&](unsigned bits) {
    return !text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0U) == bits;
  };
  while (has(0x80)) text.pop_back();
  if (has(0xC0)) text.pop_back();
}

/// Returns a text without the last characters that have no room, pixels.
std::string shortened(std::string text, double size, bool is_bold, double room) {
  const std::string end = "\u2026";
  double width = text_width(text, size, is_bold);
  if (width <= room) return text;
  while (!text.empty() && width > room) {
    const auto likely = static_cast<std::size_t>(room / width * static_cast<double>(text.size()));
    text.resize(std::min(likely, text.size() - 1));
    drop_last_of_many_bytes(text);
    width = text_width(text + end, size, is_bold);
  }
  return text + end;
}

}  // namespace

Layout::Layout(int width, int height, const Notes& notes)
    : notes_(notes),
      width_(width),
      height_(height),
      font_(std::max(8.0, 0.019 * std::sqrt(1.0 * width * height))) {
  top_ = notes.title.empty() && notes.time.empty() ? font_ : (1 + line * title_size) * font_;
  const double legend = legend_width();
  right_ = legend > 0 ? legend + 2 * font_ : font_;
  foot_ = notes.has_axes                                 ? (2 * axes_size + 2.5) * font_
          : notes.has_scale_bar || !notes.remark.empty() ? 3.2 * font_
                                                         : font_;
}

picture::Frame Layout::frame() const {
  return {font_, top_, std::max(1.0, width_ - right_ - font_),
          std::max(1.0, height_ - top_ - foot_)};
}

picture::Frame Layout::body_area() const {
  constexpr double margin = 0.5, below = 0.25;  // sizes of the font
  const picture::Frame inner = frame();
  return {inner.left - margin * font_, inner.top - margin * font_, inner.width + 2 * margin * font_,
          inner.height + (margin + below) * font_};
}

void Layout::add_to(Page& page, const picture::Camera& camera) const {
  page.title = notes_.title;
  add_heading(page);
  add_legend(page);
  if (notes_.has_scale_bar) add_scale_bar(page, camera);
  if (notes_.has_axes) add_axes(page, camera);
  if (!notes_.remark.empty())
    page.texts.push_back({width_ - right_, height_ - font_, font_, 1, notes_.remark});
}

/// A title without room beside the time gets a smaller font, and is then cut.
void Layout::add_heading(Page& page) const {
  const double base = (0.5 + title_size) * font_;
  const double time = notes_.time.empty() ? 0 : text_width(notes_.time, font_) + 2 * font_;
  if (!notes_.title.empty()) {
    const double room = std::max(font_, width_ - 2 * font_ - time),
                 natural = text_width(notes_.title, title_size * font_, true),
                 size = title_size * font_ * std::clamp(room / natural, smallest_title, 1.0);
    page.texts.push_back({font_, base, size, 0, shortened(notes_.title, size, true, room), true});
  }
  if (!notes_.time.empty()) page.texts.push_back({width_ - font_, base, font_, 1, notes_.time});
}

std::vector<std::string> Layout::scale_texts() const {
  std::vector<std::string> texts;
  for (const double mark : marks(*notes_.scale)) texts.push_back(short_number(mark, 6));
  return texts;
}

double Layout::legend_width() const {
  double widest = 0;
  if (notes_.scale) {
    for (const std::string& text : scale_texts())
      widest = std::max(widest, (bar_width + 2 * gap) * font_ + text_width(text, font_));
    for (const std::string& text : {notes_.scale->name, notes_.scale->unit})
      widest = std::max(widest, text_width(text, font_));
  }
  for (const Key& key : notes_.keys)
    widest = std::max(widest, (bar_width + gap) * font_ + text_width(key.text, font_));
  return widest;
}

void Layout::add_legend(Page& page) const {
  const double x = width_ - right_ + font_;
  double y = top_ + font_;
  if (notes_.scale) add_scale(page, x, y);
  for (const Key& key : notes_.keys) {
    page.boxes.push_back({x, y, bar_width * font_, font_, key.colour});
    page.texts.push_back({x + (bar_width + gap) * font_, y + 0.87 * font_, font_, 0, key.text});
    y += line * font_;
  }
}

void Layout::add_scale(Page& page, double x, double& y) const {
  const Scale& scale = *notes_.scale;
  for (const std::string& text : {scale.name, scale.unit}) {
    if (text.empty()) continue;
    page.texts.push_back({x, y + 0.8 * font_, font_, 0, text});
    y += 1.3 * font_;
  }
  y += 0.4 * font_;
  const double keys = line * font_ * static_cast<double>(notes_.keys.size()),
               height =
                   std::max(4 * font_, std::min(18 * font_, height_ - foot_ - y - keys - font_)),
               right = x + bar_width * font_;
  const auto steps = static_cast<int>(std::ceil(height));
  for (int n = 0; n < steps; ++n)  // each box reaches the bottom, so that no gaps appear
    page.boxes.push_back({x, y + n * height / steps, bar_width * font_, height - n * height / steps,
                          picture::colour_of(scale.map, 1 - (n + 0.5) / steps)});
  const std::vector<double> values = marks(scale);
  const std::vector<std::string> texts = scale_texts();
  const double low = scale.factor * scale.range.low, high = scale.factor * scale.range.high;
  for (std::size_t n = 0; n < values.size(); ++n) {
    const double at = y + height * (high > low ? (high - values[n]) / (high - low) : 0.5);
    page.lines.push_back({right, at, right + 0.3 * font_, at, 0.08 * font_});
    page.texts.push_back({right + gap * font_, at + 0.36 * font_, font_, 0, texts[n]});
  }
  y += height + font_;
}

/// A bar of a round length, about a fifth of the width. In perspective it holds at the depth of the
/// body's middle.
void Layout::add_scale_bar(Page& page, const picture::Camera& camera) const {
  const double length = round_below(0.2 * frame().width / camera.scale),
               left = font_ * (notes_.has_axes ? 2 * axes_size + 3.5 : 1),
               right = left + length * camera.scale, y = height_ - 1.2 * font_, half = 0.25 * font_,
               width = 0.14 * font_;
  page.lines.push_back({left, y, right, y, width});
  for (const double end : {left, right})
    page.lines.push_back({end, y - half, end, y + half, width});
  page.texts.push_back({(left + right) / 2, y - 0.5 * font_, font_, 0.5, number_text(length, "m")});
}

void Layout::add_axes(Page& page, const picture::Camera& camera) const {
  const double size = axes_size * font_, x = size + 1.5 * font_, y = height_ - size - 1.2 * font_;
  const std::pair<Vec3, const char*> axes[] = {
      {{1, 0, 0}, "x"}, {{0, 1, 0}, "y"}, {{0, 0, 1}, "z"}};
  for (const auto& [axis, name] : axes) {
    const double right = dot(axis, camera.right), up = dot(axis, camera.up),
                 length = std::hypot(right, up);
    if (length < 0.05) continue;  // it points at the eye
    const double dx = size * right, dy = -size * up, tip_x = x + dx, tip_y = y + dy,
                 along_x = right / length, along_y = -up / length, head = 0.35 * font_;
    page.lines.push_back({x, y, tip_x, tip_y, 0.1 * font_});
    for (const double side : {-0.5, 0.5})
      page.lines.push_back({tip_x, tip_y, tip_x - head * (along_x - side * along_y),
                            tip_y - head * (along_y + side * along_x), 0.1 * font_});
    double at = tip_x + 0.65 * font_ * along_x;
    const double base = tip_y + 0.65 * font_ * along_y + 0.33 * font_;
    const auto is_near = [&](const PageText& other) {
      return std::abs(other.x - at) < 0.8 * font_ && std::abs(other.y - base) < 0.9 * font_;
    };
    while (std::any_of(page.texts.begin(), page.texts.end(), is_near)) at += 0.8 * font_;
    page.texts.push_back({at, base, font_, 0.5, name});
  }
}

}  // namespace hyperlattice::render
