// The numerical search of the Brillouin zone against the closed rules of stability, on random mixtures of the springs of the fourth dimension.
#include <model/stability.hpp>
#include <support/cubic_lattice.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace {
using namespace hyperlattice;
using calibration::Ratios;

/// Waves (pi, pi, q), along the zone's edge from M to R: lengthwise motion and height push each other. The least determinant of their 2 x 2
/// matrix, as a quadratic in sin^2(q/2). The special points alone miss these, about one mixture in a thousand.
double edge_margin(const Ratios& r) {
  const double P = 16 * r.gamma / 3, coupling = 2 * r.beta - P;
  const double u0 = 8 + P, u1 = 4 + 2 * r.beta - u0, h0 = 2 * r.alpha + P / 2 + 2 * r.beta, h1 = -coupling;
  const double a = u1 * h1 + coupling * coupling, b = u0 * h1 + u1 * h0 - coupling * coupling;
  const auto at = [&](double x) { return (a * x + b) * x + u0 * h0; };
  const double lowest = a > 0 ? std::clamp(-b / (2 * a), 0.0, 1.0) : 0;
  return std::min({at(0), at(lowest), at(1)});
}

/// The rules that decide: the least of the numbers that must be positive, in units of k.
double mirrored_margin(const Ratios& r) {
  const double ka = r.alpha, kb = r.beta, kg = r.gamma;
  if (r.clamped) return std::min(2 + kb, 1.5 + kg);
  const calibration::Elasticity e = calibration::elasticity(r);
  const double least = std::min(
      {e.C3, e.C2, e.C1 - e.C2, 4 + 2 * kb, ka + 4 * kg, ka + 2 * kb + 4 * kg / 3, ka + kb + 4 * kg / 3, 8 + 2 * kb + 8 * kg / 3, edge_margin(r)});
  return e.C3 > 0 ? std::min(least, e.D1 + 2 * e.D2) : least;
}

double opposed_margin(const Ratios& r) {
  if (r.clamped) return std::min(r.beta + 8 * r.gamma / 3, 4 + 16 * r.gamma / 3);
  return std::min({r.beta, r.beta + 8 * r.gamma / 3, 4 + 16 * r.gamma / 3});
}

struct Counted {
  int samples = 0, mirrored = 0, two_layer = 0;
};

Counted compare(int samples, bool clamped) {
  std::mt19937 random(2017);
  std::uniform_real_distribution<double> ratio(-4, 5);
  Counted counted;
  while (counted.samples < samples) {
    const Ratios r{ratio(random), ratio(random), ratio(random), clamped};
    const double mirrored = mirrored_margin(r), full = std::min(mirrored, opposed_margin(r));
    if (std::abs(mirrored) < 1e-3 || (mirrored > 0 && std::abs(full) < 1e-3)) continue;  // too close to say
    ++counted.samples;
    const test::Cubic cubic(r);
    const bool stable = !find_instability(cubic.lattice, Sector::mirrored);
    EXPECT_EQ(stable, mirrored > 0) << r.alpha << ' ' << r.beta << ' ' << r.gamma << " margin " << mirrored;
    counted.mirrored += stable ? 1 : 0;
    if (!stable) continue;
    const bool both = !find_instability(cubic.lattice, Sector::opposed);
    EXPECT_EQ(both, full > 0) << r.alpha << ' ' << r.beta << ' ' << r.gamma << " margin " << full;
    counted.two_layer += both ? 1 : 0;
  }
  return counted;
}

// The shares are those of the rules themselves over a million samples.
TEST(Brillouin, FreeMembranesFollowTheClosedRules) {
  const Counted counted = compare(3000, false);
  EXPECT_NEAR(counted.mirrored / 3000.0, 0.396, 0.03);
  EXPECT_NEAR(counted.two_layer / 3000.0, 0.304, 0.03);
}

TEST(Brillouin, ClampedMembranesFollowTheClosedRules) { EXPECT_GT(compare(300, true).two_layer, 50); }

}  // namespace
