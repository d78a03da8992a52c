#include <analyze/cubic_stability.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

/// Returns the margin of the waves (pi, pi, q) on the edge of the zone from M to R, in which
/// longitudinal motion and height are coupled: the least determinant of their 2 x 2 matrix, a
/// quadratic in sin^2(q/2). The special points of the zone miss this instability for about one
/// mixture in a thousand.
double edge_margin(const calibration::Ratios& r) {
  const double P = 16 * r.gamma / 3, coupling = 2 * r.beta - P;
  const double u0 = 8 + P, u1 = 4 + 2 * r.beta - u0, h0 = 2 * r.alpha + P / 2 + 2 * r.beta,
               h1 = -coupling;
  const double a = u1 * h1 + coupling * coupling, b = u0 * h1 + u1 * h0 - coupling * coupling;
  const auto at = [&](double x) { return (a * x + b) * x + u0 * h0; };
  const double lowest = a > 0 ? std::clamp(-b / (2 * a), 0.0, 1.0) : 0;
  return std::min({at(0), at(lowest), at(1)});
}

}  // namespace

double mirrored_margin(const calibration::Ratios& r) {
  const double ka = r.alpha, kb = r.beta, kg = r.gamma;
  if (r.clamped) return std::min(2 + kb, 1.5 + kg);
  const calibration::Elasticity e = calibration::elasticity(r);
  const double least =
      std::min({e.C3, e.C2, e.C1 - e.C2, 4 + 2 * kb, ka + 4 * kg, ka + 2 * kb + 4 * kg / 3,
                ka + kb + 4 * kg / 3, 8 + 2 * kb + 8 * kg / 3, edge_margin(r)});
  return e.C3 > 0 ? std::min(least, e.D1 + 2 * e.D2) : least;
}

double opposed_margin(const calibration::Ratios& r) {
  const double shear = std::min(r.beta + 8 * r.gamma / 3, 4 + 16 * r.gamma / 3);
  return r.clamped ? shear : std::min(shear, r.beta);
}

}  // namespace hyperlattice
