// The numerical search of the Brillouin zone against the closed rules of stability, on random mixtures of the springs of the fourth dimension.
#include <analyze/cubic_stability.hpp>
#include <model/stability.hpp>
#include <support/cubic_lattice.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace {
using namespace hyperlattice;
using calibration::Ratios;

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
