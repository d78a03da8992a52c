// Stability and the critical time step of the infinite lattice, against closed forms found
// independently.
#include <model/critical_step.hpp>
#include <model/stability.hpp>
#include <model/zone.hpp>
#include <support/cubic_lattice.hpp>

#include <hyperlattice/calibration.hpp>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <algorithm>
#include <complex>
#include <random>

namespace waves_test {
using namespace hyperlattice;
using calibration::Ratios;
using test::Cubic;

double bound(const Cubic& cubic) {
  StiffnessBound sum;
  for (const NeighbourGeometry& n : cubic.lattice.neighbours)
    for (const int side : {1, -1})
      sum.add(n, side, cubic.lattice.springs[n.site.spring_class], 1, cubic.lattice.membrane);
  sum.add_alpha(cubic.lattice.alpha);
  return sum.value();
}
bool stable(const InfiniteLattice& lattice) { return !find_instability(lattice, Sector::mirrored); }

double step(const Ratios& r) { return 2 / std::sqrt(stiffest_wave(Cubic(r).lattice).stiffness); }
Ratios I_m(double lambda) { return calibration::ratios(calibration::Membrane::I_m, lambda); }

TEST(Waves, TableOfIm) {  // in sqrt(m / k)
  for (const auto& [lambda, expected] :
       {std::pair{0.0, .5774}, {.25, .5443}, {1., .4714}, {2., .3780}, {5., .2390}, {7., .2020}})
    EXPECT_NEAR(step(I_m(lambda)), expected, 6e-5) << lambda;
}

TEST(Waves, WithoutAMembrane) {
  const Cubic cubic(I_m(0));
  InfiniteLattice lattice = cubic.lattice;
  lattice.membrane = KernelChoice::Membrane::none;
  EXPECT_NEAR(stiffest_wave(lattice).stiffness, 12, 1e-9);
  EXPECT_TRUE(stable(lattice));
}

TEST(Waves, ClosedFormForPositiveStiffness) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> ratio(0, 5);
  for (int n = 0; n < 30; ++n) {
    const Ratios r{ratio(random), ratio(random), ratio(random), n % 3 == 0};
    const calibration::Elasticity e = calibration::elasticity(r);
    const double expected = r.clamped ? 2 * e.C1 : std::max(2 * e.C1, 2 * e.C3);
    const Cubic cubic(r);
    EXPECT_NEAR(stiffest_wave(cubic.lattice).stiffness, expected, 1e-7 * expected)
        << r.alpha << ' ' << r.beta << ' ' << r.gamma;
    EXPECT_NEAR(bound(cubic), expected,
                1e-12 * expected);  // for one material, the bound for several is exact
    EXPECT_TRUE(stable(cubic.lattice));
  }
}

TEST(Waves, MembraneIVWithNegativeLambda) {
  for (const double lambda : {-1.9, -1.0, -0.3}) {
    const Cubic cubic(calibration::ratios(calibration::Membrane::IV, lambda));
    EXPECT_NEAR(stiffest_wave(cubic.lattice).stiffness, 12 + 2 * lambda, 1e-6);
    EXPECT_GE(bound(cubic), 12 + 2 * lambda);
  }
}

TEST(Waves, NamesTheWave) {
  EXPECT_EQ(describe(stiffest_wave(Cubic(I_m(5)).lattice)),
            "the wave with vector (0, 0, 0) a spacing, moving in the fourth dimension");
  const std::string longitudinal = describe(stiffest_wave(Cubic(I_m(1)).lattice));
  EXPECT_NE(longitudinal.find("pi"), std::string::npos) << longitudinal;
  EXPECT_EQ(longitudinal.find("fourth"), std::string::npos) << longitudinal;
}

/// Errors of the phase velocities in percent, least and largest over all directions.
struct SpeedErrors {
  double p_least, p_largest, s_least, s_largest;
};

/// The cubic lattice with volumetric energy; waves of `points` spacings. k = l = m = 1, so the
/// speeds of the continuum are the roots of C11 = 3 + K_v and C44 = 1.
SpeedErrors speed_errors(double poisson, double points) {
  const Cubic cubic({0, 0, 0, false});
  InfiniteLattice lattice = cubic.lattice;
  lattice.membrane = KernelChoice::Membrane::none;
  lattice.volumetric = (4 * poisson - 1) / (1 - 2 * poisson);
  const double p_speed = std::sqrt(3 + lattice.volumetric), q = 2 * pi / points;
  SpeedErrors errors{1e9, -1e9, 1e9, -1e9};
  // Directions between [100], [110] and [111]; all others are equal to them by symmetry.
  constexpr int steps = 28;
  for (int j = 0; j <= steps; ++j)
    for (int k = 0; k <= j; ++k) {
      Vec3 along{1, 1.0 * j / steps, 1.0 * k / steps};
      along = along / norm(along);
      std::vector<Wave> found = waves(lattice, q * along, Sector::mirrored);
      // The P wave moves along its vector.
      std::sort(found.begin(), found.end(), [&](const Wave& a, const Wave& b) {
        return std::abs(dot(a.direction, along)) < std::abs(dot(b.direction, along));
      });
      const auto percent = [&](const Wave& wave, double speed) {
        return 100 * (std::sqrt(wave.stiffness) / q / speed - 1);
      };
      const double p = percent(found[2], p_speed);
      errors.p_least = std::min(errors.p_least, p);
      errors.p_largest = std::max(errors.p_largest, p);
      for (const double s : {percent(found[0], 1), percent(found[1], 1)}) {
        errors.s_least = std::min(errors.s_least, s);
        errors.s_largest = std::max(errors.s_largest, s);
      }
    }
  return errors;
}

/// The table of docs/theory/convergence.md, from an independent prototype.
TEST(WaveSpeeds, AreThoseOfThePrototype) {
  struct Case {
    double poisson, points, p_least, p_largest;
  };
  for (const Case& of : {Case{0, 5, -7.8, -4.7},
                         {0, 10, -2.0, -1.1},
                         {0, 20, -.51, -.28},
                         {0.25, 5, -9.4, -6.5},
                         {0.25, 10, -2.4, -1.6},
                         {0.25, 20, -.62, -.41},
                         {0.4, 5, -11.1, -6.5},
                         {0.4, 10, -2.9, -1.6},
                         {0.4, 20, -.73, -.41},
                         {0.45, 5, -12.6, -6.5},
                         {0.45, 10, -3.3, -1.6},
                         {0.45, 20, -.83, -.41},
                         {0.49, 5, -14.1, -6.5},
                         {0.49, 10, -3.7, -1.6},
                         {0.49, 20, -.93, -.41}}) {
    const SpeedErrors found = speed_errors(of.poisson, of.points);
    const double digit = of.points < 20 ? 0.06 : 0.006;
    EXPECT_NEAR(found.p_least, of.p_least, digit) << of.poisson << ", " << of.points;
    EXPECT_NEAR(found.p_largest, of.p_largest, digit) << of.poisson << ", " << of.points;
    // S waves hardly change the volume; so their speeds hardly know the Poisson ratio.
    const bool coarse = of.points == 5, middle = of.points == 10;
    EXPECT_NEAR(found.s_least, coarse ? -7.4 : middle ? -1.9 : -.48, digit) << of.poisson;
    EXPECT_NEAR(found.s_largest, coarse ? -3.0 : middle ? -.75 : -.19, 2 * digit) << of.poisson;
  }
}

TEST(WaveStability, ClampedMembranesNeedPositiveSpringsInSpace) {
  using calibration::Membrane;
  const auto is_stable = [](Membrane membrane, double lambda) {
    return stable(Cubic(calibration::ratios(membrane, lambda)).lattice);
  };
  EXPECT_TRUE(is_stable(Membrane::III, -1.45));
  EXPECT_FALSE(is_stable(Membrane::III, -1.55));
  EXPECT_TRUE(is_stable(Membrane::IV, -1.9));
  EXPECT_FALSE(is_stable(Membrane::IV, -2.1));
  EXPECT_FALSE(is_stable(Membrane::I_m, -0.05));
}

TEST(WaveStability, SaysWhatGrows) {
  const auto found = find_instability(Cubic(I_m(-0.1)).lattice, Sector::mirrored);
  ASSERT_TRUE(found);
  EXPECT_NE(describe(*found).find("height"), std::string::npos) << describe(*found);
}

// With negative cross springs, the two layers of a clamped membrane shear past each other in
// opposed waves.
TEST(WaveStability, ClampedMembranesOfTwoLayersNeedPositiveCrossSprings) {
  using calibration::Membrane;
  for (const Membrane membrane : {Membrane::III, Membrane::IV}) {
    EXPECT_FALSE(
        find_instability(Cubic(calibration::ratios(membrane, 0.01)).lattice, Sector::opposed));
    const auto found =
        find_instability(Cubic(calibration::ratios(membrane, -0.01)).lattice, Sector::opposed);
    ASSERT_TRUE(found);
    EXPECT_NE(describe(*found).find("the two layers oppositely, grows"), std::string::npos)
        << describe(*found);
  }
}

// The dynamical matrix of both layers, summed spring by spring, for a comparison with the two
// sectors.
Eigen::VectorXd two_layers(const Cubic& cubic, Vec3 q) {
  using Vector8 = Eigen::Matrix<std::complex<double>, 8, 1>;
  Eigen::Matrix<std::complex<double>, 8, 8> sum = Eigen::Matrix<std::complex<double>, 8, 8>::Zero();
  const auto spring = [&](double stiffness, const Neighbour& site, Eigen::Vector4d along, int from,
                          int to) {
    const std::complex<double> phase =
        std::polar(1.0, q.x * site.dx + q.y * site.dy + q.z * site.dz);
    Vector8 stretch = Vector8::Zero();
    stretch.segment<4>(4 * to) += phase * along.normalized();
    stretch.segment<4>(4 * from) -= along.normalized();
    sum += stiffness * stretch.conjugate() * stretch.transpose();
  };
  for (const NeighbourGeometry& n : cubic.lattice.neighbours) {
    const SpringConstants& constants = cubic.lattice.springs[n.site.spring_class];
    for (const int layer : {0, 1}) {
      const double down = layer == 0 ? -1 : 1;  // layer 0 lies above the mirror
      spring(constants.stiffness, n.site, {n.rest.x, n.rest.y, n.rest.z, 0}, layer, layer);
      spring(constants.cross_stiffness, n.site, {n.rest.x, n.rest.y, n.rest.z, down}, layer,
             1 - layer);
    }
  }
  spring(cubic.lattice.alpha, {}, {0, 0, 0, -1}, 0, 1);
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>(sum).eigenvalues();
}

TEST(Waves, TwoSectorsAreTheWholeTwoLayerLattice) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> ratio(-4, 5), angle(-3, 3);
  for (int n = 0; n < 50; ++n) {
    const Cubic cubic({ratio(random), ratio(random), ratio(random), false});
    const Vec3 q{angle(random), angle(random), angle(random)};
    std::vector<double> found;
    for (const Sector sector : {Sector::mirrored, Sector::opposed})
      for (const Wave& wave : waves(cubic.lattice, q, sector)) found.push_back(wave.stiffness);
    std::sort(found.begin(), found.end());
    const Eigen::VectorXd expected = two_layers(cubic, q);
    ASSERT_EQ(found.size(), 8u);
    for (std::size_t mode = 0; mode < 8; ++mode)
      EXPECT_NEAR(found[mode], expected(static_cast<Eigen::Index>(mode)), 1e-11);
  }
}

}  // namespace waves_test
