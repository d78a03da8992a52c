// A plot as an SVG element of a page: curves, axes, ticks at round numbers, units, legend. Its
// colours come from the style of the page (style.hpp) and suit light, dark and paper. (Pictures in
// their own files, with logarithmic axes and labels at points, use gnuplot: base/gnuplot.hpp. A
// report must work without gnuplot.)
#pragma once

#include <string>
#include <vector>

namespace hyperlattice::report {

/// One curve of a plot.
struct Series {
  std::string label;
  std::vector<double> x, y;  ///< of equal length, in SI; a value that is not finite is a gap
  bool is_dashed = false;    ///< a dashed curve does not hide the curve below it
};

/// One axis of a plot.
struct Axis {
  std::string name;  ///< "time"
  std::string unit;  ///< SI unit; empty for a number without unit
  bool is_count = false;
};

/// A plot with its curves.
struct Plot {
  std::string title;
  Axis x, y;
  std::vector<Series> series;
};

/// Returns whether the plot has a point to draw.
bool has_points(const Plot& plot);

/// Returns the SVG element. A curve with few points has a dot at each.
std::string svg(const Plot& plot);

}  // namespace hyperlattice::report
