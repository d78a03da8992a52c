#include <state/damage_growth.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyperlattice {

PrincipalStress principal_values(const Symmetric& stress) {
  const auto [xx, yy, zz, yz, xz, xy] = stress;
  const double mean = (xx + yy + zz) / 3, x = xx - mean, y = yy - mean, z = zz - mean;
  const double radius = std::sqrt((x * x + y * y + z * z + 2 * (yz * yz + xz * xz + xy * xy)) / 6);
  if (!(radius > 0)) return {mean, mean, mean};
  const double determinant =
      x * (y * z - yz * yz) - xy * (xy * z - yz * xz) + xz * (xy * yz - y * xz);
  const double cosine = std::clamp(determinant / (2 * radius * radius * radius), -1.0, 1.0);
  const double angle = std::acos(cosine) / 3;
  const double first = mean + 2 * radius * std::cos(angle),
               third = mean + 2 * radius * std::cos(angle + 2 * std::numbers::pi / 3);
  return {first, 3 * mean - first - third, third};
}

double damage_lag(const DamageStep& of) {
  const double left = 1 - of.damage, bottom = of.shape + (1 - of.shape) * left * left;
  return left / (bottom * bottom) * of.drive - left + of.spread;
}

double damage_rate(const DamageStep& of) {
  /// The left side of the equation and its derivative.
  struct Side {
    double value, slope;
  };
  const double dt = of.time_step;
  const auto side = [&](double x) {
    const double left = 1 - of.damage - dt * x, square = (1 - of.shape) * left * left,
                 bottom = of.shape + square;
    return Side{left / (bottom * bottom) * of.drive - left + of.spread -
                    of.inertia * (x - of.rate) / dt - of.viscosity * x,
                -dt * (bottom - 4 * square) / (bottom * bottom * bottom) * of.drive + dt -
                    of.inertia / dt - of.viscosity};
  };
  double low = 0, high = (1 - of.damage) / dt;
  if (!(side(low).value > 0)) return 0;
  if (side(high).value >= 0) return high;
  double x = std::clamp(of.rate, low, high);
  constexpr int most = 100;  // bisections alone would need 53
  for (int n = 0; n < most; ++n) {
    const Side now = side(x);
    if (now.value == 0) return x;
    (now.value > 0 ? low : high) = x;
    double next = x - now.value / now.slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const bool found = std::abs(next - x) <= 1e-15 * std::abs(next);
    x = next;
    if (found || low >= high) break;
  }
  return x;
}

}  // namespace hyperlattice
