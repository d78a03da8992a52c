// A plot as an SVG element of a page: curves, axes, ticks in round numbers, units, legend. Its
// colours come from the page's style (style.hpp), so that they suit light, dark and paper.
// (Pictures that are files of their own, with logarithmic axes and labels at points, are drawn by
// gnuplot: base/gnuplot.hpp. A report has to work without it.)
#pragma once

#include <string>
#include <vector>

namespace hyperlattice::report {

struct Series {
  std::string label;
  std::vector<double> x, y;  ///< as many of each, in SI; what is not finite is a gap
  bool is_dashed = false;    ///< so that a curve below it shows
};

struct Axis {
  std::string name;  ///< "time"
  std::string unit;  ///< in SI; empty: a number
  bool is_count = false;
};

struct Plot {
  std::string title;
  Axis x, y;
  std::vector<Series> series;
};

/// Whether there is anything to draw.
bool has_points(const Plot& plot);

/// The element. A curve of few points has a dot at each.
std::string svg(const Plot& plot);

}  // namespace hyperlattice::report
