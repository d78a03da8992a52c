// The path of one spring as an SVG, written without a library: small, and the same bytes on every
// machine.
#include <base/gnuplot.hpp>
#include <contract/lone_spring.hpp>

#include <hyperlattice/files.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace hyperlattice::contract {
namespace {

constexpr double width = 420, height = 300, left = 64, right = 16, top = 32, bottom = 44;

/// A range of values and its range in the picture.
struct Axis {
  double low = 0, high = 0, from = 0, to = 0;

  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// Returns the position in pixels, rounded to tenths. It is rounded twice, since kernels of other
  /// instruction sets differ in the last bits, which must not decide how a half is rounded.
  double place(double value) const {
    const double at = from + (to - from) * (value - low) / (high > low ? high - low : 1);
    return std::round(std::round(at * 1e6) / 1e6 * 10) / 10 + 0.0;
  }
};

std::string line(double x1, double y1, double x2, double y2, const char* colour) {
  return fmt::format("<path d=\"M{} {}L{} {}\" stroke=\"{}\"/>\n", x1, y1, x2, y2, colour);
}
std::string text(double x, double y, const char* anchor, const std::string& words) {
  return fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, words);
}
/// Returns a number with three digits, without "-0".
std::string label(double value, double unit) { return short_number(value / unit + 0.0, 3); }

}  // namespace

std::string picture(const std::string& title, const std::vector<PathPoint>& path) {
  constexpr double micrometre = 1e-6;
  Axis x{0, 0, left, width - right}, y{0, 0, height - bottom, top};
  for (const PathPoint& point : path) {
    x.include(point.elongation);
    y.include(point.force);
  }
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" font-family=\"sans-serif\" font-size=\"12\" "
      "fill=\"none\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n",
      width, height);
  svg += line(left, y.place(0), width - right, y.place(0), "#bbb") +
         line(x.place(0), top, x.place(0), height - bottom, "#bbb");
  svg += fmt::format("<path stroke=\"{}\" stroke-width=\"1.6\" d=\"", plot_colours[0]);
  for (std::size_t n = 0; n < path.size(); n += 5)
    fmt::format_to(std::back_inserter(svg), "{}{} {}", n == 0 ? "M" : "L",
                   x.place(path[n].elongation), y.place(path[n].force));
  svg += "\"/>\n<g fill=\"#333\">\n";
  svg += text(width / 2, 18, "middle", title);
  svg += text((left + width - right) / 2, height - 10, "middle", "elongation in um");
  svg += text(left, 18, "middle", "force in N");
  for (const double end : {x.low, x.high})
    svg += text(x.place(end), height - bottom + 16, end == x.low ? "start" : "end",
                label(end, micrometre));
  for (const double end : {y.low, y.high})
    svg += text(left - 6, y.place(end) + 4, "end", label(end, 1));
  return svg + "</g>\n</svg>\n";
}

}  // namespace hyperlattice::contract
