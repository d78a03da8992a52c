// The numerical search of the Brillouin zone against the closed rules of stability, on random
// ratios of the springs into the fourth dimension.
#include <analyze/cubic_stability.hpp>
#include <analyze/elasticity.hpp>
#include <analyze/load_lattice.hpp>
#include <analyze/membranes.hpp>
#include <model/stability.hpp>
#include <support/cubic_lattice.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace brillouin_test {
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
    if (std::abs(mirrored) < 1e-3 || (mirrored > 0 && std::abs(full) < 1e-3))
      continue;  // too close to the limit
    ++counted.samples;
    const test::Cubic cubic(r);
    const bool stable = !find_instability(cubic.lattice, Sector::mirrored);
    EXPECT_EQ(stable, mirrored > 0)
        << r.alpha << ' ' << r.beta << ' ' << r.gamma << " margin " << mirrored;
    counted.mirrored += stable ? 1 : 0;
    if (!stable) continue;
    const bool both = !find_instability(cubic.lattice, Sector::opposed);
    EXPECT_EQ(both, full > 0) << r.alpha << ' ' << r.beta << ' ' << r.gamma << " margin " << full;
    counted.two_layer += both ? 1 : 0;
  }
  return counted;
}

// The fractions of stable samples come from the rules alone, over a million samples.
TEST(Brillouin, FreeMembranesFollowTheClosedRules) {
  const Counted counted = compare(3000, false);
  EXPECT_NEAR(counted.mirrored / 3000.0, 0.396, 0.03);
  EXPECT_NEAR(counted.two_layer / 3000.0, 0.304, 0.03);
}

TEST(Brillouin, ClampedMembranesFollowTheClosedRules) {
  EXPECT_GT(compare(300, true).two_layer, 50);
}

// The centred lattices have no closed rules for all waves. Uniform strains give necessary
// conditions: C44, C11 - C12 and C11 + 2 C12 of the relaxed layer, and the stiffness C3 of its
// thickness, must be positive.
double elastic_margin(const LatticeElasticity& e, bool clamped) {
  const double least = std::min({e.C44, e.C11 - e.C12, e.C11 + 2 * e.C12});
  return clamped ? least : std::min(least, e.C3);
}

class CentredBrillouin : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Lattices, CentredBrillouin, testing::Values("bcc", "fcc"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(CentredBrillouin, StabilityNeedsElasticStabilityAndHoldsForAnyWave) {
  Host host;
  const LatticeGeometry geometry = load_lattice(host, std::string("lattices.") + GetParam());
  std::mt19937 random(2017);
  std::uniform_real_distribution<double> ratio(-3, 5), angle(-6.3, 6.3);
  int stable = 0, by_waves = 0;
  for (int n = 0; n < 600; ++n) {
    const Ratios r{ratio(random), ratio(random), ratio(random), n % 3 == 0};
    const SpringLattice lattice = with_ratios(geometry, r);
    const double margin = elastic_margin(elasticity(lattice), r.clamped);
    if (std::abs(margin) < 1e-3) continue;  // too close to the limit
    const auto found = find_instability(lattice.endless(), Sector::mirrored);
    if (margin < 0) {
      EXPECT_TRUE(found) << r.alpha << ' ' << r.beta << ' ' << r.gamma << " margin " << margin;
      continue;
    }
    if (found) {
      EXPECT_FALSE(found->homogeneous);
      EXPECT_LT(stiffness_range(lattice.endless(), found->wave.vector, Sector::mirrored).softest,
                0);
      ++by_waves;
      continue;
    }
    ++stable;
    for (int sample = 0; sample < 200; ++sample) {
      const Vec3 q{angle(random), angle(random), angle(random)};
      EXPECT_GE(stiffness_range(lattice.endless(), q, Sector::mirrored).softest, -1e-9)
          << r.alpha << ' ' << r.beta << ' ' << r.gamma;
    }
  }
  EXPECT_GT(stable, 100);
  EXPECT_GT(by_waves, 5);
}

// The clamped body-centred lattice acts as a lattice of springs in space: k + 3 k_beta / 7 to the
// first neighbours and 2 k / 3 + k_gamma / 2 to the second. Both must be positive. This is also
// sufficient: every spring then takes up energy, and no motion leaves all springs at their length.
TEST(Brillouin, ClampedBodyCentredLatticesNeedBothSpringsPositive) {
  Host host;
  const LatticeGeometry geometry = load_lattice(host, "lattices.bcc");
  std::mt19937 random(3);
  std::uniform_real_distribution<double> ratio(-5, 5);
  int stable = 0;
  for (int n = 0; n < 300; ++n) {
    const Ratios r{0, ratio(random), ratio(random), true};
    const double margin = std::min(1 + 3 * r.beta / 7, 2.0 / 3 + r.gamma / 2);
    if (std::abs(margin) < 1e-3) continue;
    EXPECT_EQ(!find_instability(with_ratios(geometry, r).endless(), Sector::mirrored), margin > 0)
        << r.beta << ' ' << r.gamma;
    stable += margin > 0 ? 1 : 0;
  }
  EXPECT_GT(stable, 100);
}

}  // namespace brillouin_test
