#include <base/figures.hpp>
#include <base/ticks.hpp>
#include <report/html.hpp>
#include <report/plot.hpp>
#include <report/style.hpp>
#include <report/thin.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace hyperlattice::report {

namespace {

constexpr double width = 640, inner_height = 270, line_height = 18, letter = 6.6, right = 18,
                 bottom = 40, sample = 22;
constexpr std::size_t few = 24;  // a curve with at most so many points has dots

/// Returns whether a number can be drawn; differences of larger numbers overflow.
bool is_drawable(double value) { return std::abs(value) < 1e300; }
bool has_point(const Series& series, std::size_t n) {
  return is_drawable(series.x[n]) && is_drawable(series.y[n]);
}

/// Returns the number of characters of UTF-8 text.
double letters(const std::string& text) {
  return static_cast<double>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

struct Range {
  double low = 0, high = 0;
  bool empty = true;

  void take(double value) {
    low = empty ? value : std::min(low, value);
    high = empty ? value : std::max(high, value);
    empty = false;
  }
  double largest() const { return std::max(std::abs(low), std::abs(high)); }
  /// Gives an empty range an extent, so that it can be drawn.
  void widen() {
    if (high - low > 1e-9 * largest()) return;
    const double half = largest() > 0 ? 0.5 * largest() : 0.5;
    const double middle = 0.5 * (low + high);
    low = middle - half;
    high = middle + half;
  }
};

/// An axis in the picture: its range in scaled numbers, its ticks, and its position.
struct DrawnAxis {
  Scale scale;
  Range range;
  double begin = 0, end = 0;  ///< position in the picture
  std::vector<Tick> ticks;

  double place(double value) const {
    return begin + (value / scale.factor - range.low) / (range.high - range.low) * (end - begin);
  }
  double place_of_tick(const Tick& tick) const { return place(tick.value * scale.factor); }
};

DrawnAxis drawn(const Axis& axis, Range range, int ticks) {
  DrawnAxis result;
  range.widen();
  result.scale = scale_for(range.largest(), axis.unit);
  result.range = {range.low / result.scale.factor, range.high / result.scale.factor, false};
  result.ticks = round_ticks(result.range.low, result.range.high, ticks,
                             axis.is_count && result.scale.factor == 1);
  return result;
}

std::string axis_label(const Axis& axis, const Scale& scale) {
  return scale.unit.empty() ? axis.name : axis.name + " in " + scale.unit;
}

/// Returns the range of the curves with a margin; it starts or ends at zero if the curves come near
/// zero.
Range padded(Range range) {
  const double margin = 0.05 * (range.high - range.low);
  const bool from_zero = range.low >= 0 && range.low < 0.3 * range.high,
             to_zero = range.high <= 0 && range.high > 0.3 * range.low;
  return {from_zero ? 0 : range.low - margin, to_zero ? 0 : range.high + margin, false};
}

std::string style_class(const Series& series, std::size_t number) {
  return fmt::format("c{} d{}", number % curve_colours,
                     (number / curve_colours + (series.is_dashed ? 1 : 0)) % curve_dashes);
}

class Picture {
 public:
  explicit Picture(const Plot& plot) : plot_(plot) {
    Range x_range, y_range;
    for (const Series& series : plot.series)
      for (std::size_t n = 0; n < series.x.size(); ++n)
        if (has_point(series, n)) {
          x_range.take(series.x[n]);
          y_range.take(series.y[n]);
        }
    x_ = drawn(plot.x, x_range, 7);
    y_ = drawn(plot.y, padded(y_range), 6);
    double longest = 1;
    for (const Tick& tick : y_.ticks) longest = std::max(longest, letters(tick.label));
    x_.begin = 14 + letter * longest;
    x_.end = width - right;
  }

  std::string draw() {
    draw_legend();
    y_.end = top_ + 8;
    y_.begin = y_.end + inner_height;
    draw_axes();
    for (std::size_t n = 0; n < plot_.series.size(); ++n) draw_curve(plot_.series[n], n);
    return fmt::format("<svg viewBox=\"0 0 {} {:.0f}\" role=\"img\" aria-label=\"{}\">\n{}</svg>\n",
                       width, y_.begin + bottom, escaped(plot_.title), body_);
  }

 private:
  template <class... Values>
  void put(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(body_), format, std::forward<Values>(values)...);
  }

  void draw_legend() {
    if (plot_.series.size() > 1) {
      double x = 4;
      top_ = line_height;
      for (std::size_t n = 0; n < plot_.series.size(); ++n) {
        const std::string& label = plot_.series[n].label;
        const double needed = sample + 6 + letter * letters(label) + 16;
        if (x > 4 && x + needed > width) {
          x = 4;
          top_ += line_height;
        }
        put("<path class=\"curve {}\" d=\"M{:.1f} {:.1f}h{}\"/><text x=\"{:.1f}\" "
            "y=\"{:.1f}\">{}</text>\n",
            style_class(plot_.series[n], n), x, top_ - 9, sample, x + sample + 6, top_ - 5,
            escaped(label));
        x += needed;
      }
    }
    top_ += line_height;
    put("<text class=\"axis\" x=\"4\" y=\"{:.1f}\">{}</text>\n", top_ - 4,
        escaped(axis_label(plot_.y, y_.scale)));
  }

  void draw_axes() {
    for (const Tick& tick : y_.ticks) {
      const double y = y_.place_of_tick(tick);
      put("<path class=\"{}\" d=\"M{:.1f} {:.1f}H{:.1f}\"/><text class=\"end\" x=\"{:.1f}\" "
          "y=\"{:.1f}\">{}</text>\n",
          tick.value == 0 ? "zero" : "grid", x_.begin, y, x_.end, x_.begin - 6, y + 4, tick.label);
    }
    for (const Tick& tick : x_.ticks) {
      const double x = x_.place_of_tick(tick);
      put("<path class=\"grid\" d=\"M{:.1f} {:.1f}V{:.1f}\"/><text class=\"middle\" x=\"{:.1f}\" "
          "y=\"{:.1f}\">{}</text>\n",
          x, y_.begin, y_.end, x, y_.begin + 16, tick.label);
    }
    put("<path class=\"frame\" d=\"M{:.1f} {:.1f}V{:.1f}H{:.1f}\"/>\n", x_.begin, y_.end, y_.begin,
        x_.end);
    put("<text class=\"axis middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
        0.5 * (x_.begin + x_.end), y_.begin + 34, escaped(axis_label(plot_.x, x_.scale)));
  }

  void draw_curve(const Series& series, std::size_t number) {
    const auto kept = thinned(series.x, series.y, static_cast<std::size_t>(x_.end - x_.begin));
    std::string path, dots;
    bool is_down = false;
    for (const std::size_t n : kept) {
      if (!has_point(series, n)) {
        is_down = false;
        continue;
      }
      const double x = x_.place(series.x[n]), y = y_.place(series.y[n]);
      fmt::format_to(std::back_inserter(path), "{}{:.1f} {:.1f}", is_down ? "L" : "M", x, y);
      if (series.x.size() <= few)
        fmt::format_to(std::back_inserter(dots), "M{:.1f} {:.1f}h0", x, y);
      is_down = true;
    }
    if (path.empty()) return;
    put("<path class=\"curve {}\" d=\"{}\"><title>{}</title></path>\n", style_class(series, number),
        path, escaped(series.label));
    if (!dots.empty())
      put("<path class=\"dots {}\" d=\"{}\"/>\n", style_class(series, number), dots);
  }

  const Plot& plot_;
  DrawnAxis x_, y_;
  double top_ = 0;  ///< upper end of the free space
  std::string body_;
};

}  // namespace

bool has_points(const Plot& plot) {
  return std::any_of(plot.series.begin(), plot.series.end(), [](const Series& series) {
    for (std::size_t n = 0; n < series.x.size(); ++n)
      if (has_point(series, n)) return true;
    return false;
  });
}

std::string svg(const Plot& plot) { return Picture(plot).draw(); }

}  // namespace hyperlattice::report
