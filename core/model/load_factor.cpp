// Means and integrals of a load factor over an interval. Corners cut the interval into pieces.
// Inside a piece the factor is smooth; it is never evaluated at a corner itself, where it may jump.
#include <model/load.hpp>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

namespace {

/// Returns the mean over a piece by Gauss quadrature with an odd number of points. The result is
/// exact for constants to the last bit, because it is the middle value plus weighted differences
/// from it.
template <unsigned points>
double mean_of_piece(const Load& load, double from, double to) {
  using Gauss = boost::math::quadrature::gauss<double, points>;
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from),
               at_middle = load.factor(middle);
  double differences = 0;
  for (std::size_t n = 1; n < Gauss::abscissa().size(); ++n) {  // point 0 is the middle
    const double away = half * Gauss::abscissa()[n];
    differences += Gauss::weights()[n] * ((load.factor(middle - away) - at_middle) +
                                          (load.factor(middle + away) - at_middle));
  }
  return at_middle + 0.5 * differences;
}

/// Calls visit(from, to) for each piece between corners.
template <class Visit>
void for_pieces(const std::vector<double>& corners, double from, double to, const Visit& visit) {
  for (auto corner = std::upper_bound(corners.begin(), corners.end(), from);
       corner != corners.end() && *corner < to; ++corner) {
    visit(from, *corner);
    from = *corner;
  }
  visit(from, to);
}

}  // namespace

double Load::after(double time) const {
  return factor(std::binary_search(corners.begin(), corners.end(), time)
                    ? std::nextafter(time, infinity)
                    : time);
}

double Load::mean(double from, double to) const {
  if (!(to > from)) return factor(to);
  const auto corner = std::upper_bound(corners.begin(), corners.end(), from);
  if (corner == corners.end() || *corner >= to) return mean_of_piece<7>(*this, from, to);
  double first = 0, differences = 0;
  bool any = false;
  for_pieces(corners, from, to, [&](double begin, double end) {
    const double piece = mean_of_piece<15>(*this, begin, end);  // a piece may be a whole pulse
    if (!any) first = piece;
    any = true;
    differences += (end - begin) * (piece - first);
  });
  return first + differences / (to - from);
}

double Load::integral(double from, double to) const {
  if (!(to > from)) return 0;
  double sum = 0;
  for_pieces(corners, from, to, [&](double begin, double end) {
    constexpr unsigned halvings = 12;
    // Relative to the difference of two rules; the better rule has a far smaller error. Time itself
    // has little more accuracy.
    constexpr double tolerance = 1e-9;
    sum += boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
        [this](double time) { return factor(time); }, begin, end, halvings, tolerance);
  });
  return sum;
}

Load::Limit Load::limit(double time, double reach) const {
  const double nearby = 1e-6 * std::abs(reach);  // a nearer corner is at `time`
  const auto from = std::lower_bound(corners.begin(), corners.end(), time - nearby);
  const auto to = std::upper_bound(from, corners.end(), time + nearby);
  if (reach > 0 && to != corners.end()) reach = std::min(reach, *to - time);
  if (reach < 0 && from != corners.begin()) reach = std::max(reach, *std::prev(from) - time);
  const double apart = reach / 4, a = factor(time + apart), b = factor(time + 2 * apart),
               c = factor(time + 3 * apart);  // three points of a parabola
  const double value = from == to ? factor(time) : a + 2 * (a - b) + (c - b);
  return {value, (2.5 * (b - a) + 1.5 * (b - c)) / apart};
}

}  // namespace hyperlattice
