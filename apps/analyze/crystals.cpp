// With t = 2 l / k, the constants t C11, t C12, t C44 are D1, D2, D3 of the lattice, and
//   k_gamma = 3/4 (t C44 - 2),   k_beta = t (C11 - C12 - C44) - 2,
//   k_alpha = (t P - 6)^2 / (t X) - 3 t (C11 - C12) + 12
// with P = C11 - C12 + C44 and X = C44 - C12. The relaxation of a free height reduces C12 below C44
// by C4^2 / C3 = t X.
#include <analyze/crystals.hpp>
#include <analyze/cubic_stability.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

namespace {

calibration::Ratios ratios_at(const Crystal& c, double t) {
  const double P = c.C11 - c.C12 + c.C44, X = c.C44 - c.C12;
  calibration::Ratios ratios{0, t * (c.C11 - c.C12 - c.C44) - 2, 0.75 * (t * c.C44 - 2), X == 0};
  if (X == 0)
    ratios.beta =
        t * c.C11 - 6 -
        8 * ratios.gamma / 3;  // Cauchy's relation C12 = C44 holds for clamped heights only
  else
    ratios.alpha = (t * P - 6) * (t * P - 6) / (t * X) - 3 * t * (c.C11 - c.C12) + 12;
  return ratios;
}

bool within(double ratio) { return ratio >= least_ratio && ratio <= most_ratio; }
bool within(const calibration::Ratios& r) {
  return within(r.alpha) && within(r.beta) && within(r.gamma);
}

/// Returns every t at which a ratio crosses a limit, ascending, with 0 first.
std::vector<double> crossings(const Crystal& c) {
  std::vector<double> found{0};
  const double P = c.C11 - c.C12 + c.C44, X = c.C44 - c.C12;
  for (const double limit : {least_ratio, most_ratio}) {
    found.push_back((limit / 0.75 + 2) / c.C44);
    found.push_back((limit + 2) / (c.C11 - c.C12 - c.C44));
    if (X == 0) continue;
    const double a = P * P / X - 3 * (c.C11 - c.C12), b = 12 - limit - 12 * P / X,
                 root = std::sqrt(b * b - 4 * a * 36 / X);
    found.push_back((-b + root) / (2 * a));
    found.push_back((-b - root) / (2 * a));
  }
  std::erase_if(found, [](double t) { return !(t >= 0 && std::isfinite(t)); });
  std::sort(found.begin(), found.end());
  return found;
}

int rank(const CrystalFit& fit) { return (fit.mirrored ? 1 : 0) + (fit.two_layer ? 1 : 0); }
double size(const calibration::Ratios& r) {
  return r.alpha * r.alpha + r.beta * r.beta + r.gamma * r.gamma;
}

}  // namespace

std::optional<CrystalFit> fit(const Crystal& crystal) {
  constexpr int samples = 400;
  std::optional<CrystalFit> best;
  const std::vector<double> ends = crossings(crystal);
  for (std::size_t n = 1; n < ends.size(); ++n)
    for (int sample = 0; sample < samples; ++sample) {
      const double t = ends[n - 1] + (ends[n] - ends[n - 1]) * (sample + 0.5) / samples;
      CrystalFit found{ratios_at(crystal, t), 2 / t, false, false};
      if (!within(found.ratios)) break;  // as all t up to the next crossing
      found.mirrored = mirrored_margin(found.ratios) > 0;
      found.two_layer = found.mirrored && opposed_margin(found.ratios) >= 0;
      if (!best || rank(found) > rank(*best) ||
          (rank(found) == rank(*best) && size(found.ratios) < size(best->ratios)))
        best = found;
    }
  return best;
}

}  // namespace hyperlattice
