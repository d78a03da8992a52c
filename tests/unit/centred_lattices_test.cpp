// The body-centred and the face-centred cubic lattice. Sites and springs are compared with pairs of
// points counted one by one, and elasticity with sums over the neighbours.
#include <analyze/elasticity.hpp>
#include <analyze/load_lattice.hpp>
#include <analyze/membranes.hpp>
#include <analyze/virtual_test.hpp>
#include <model/stability.hpp>
#include <support/components.hpp>
#include <support/models.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace centred_lattices_test {
using namespace hyperlattice;
using namespace hyperlattice::test;
using calibration::Membrane;
using calibration::Ratios;

/// A lattice as in a textbook; the edge of the cubic cell is 1.
struct Crystal {
  const char* name;
  std::vector<Vec3> cell;         ///< particles of the cell
  std::array<double, 2> squares;  ///< squared lengths of springs to first and second neighbours
  std::array<double, 2> base_stiffness;  ///< stiffness over k
  double isotropic;                      ///< k_gamma / k_beta of an isotropic lattice
};
const Crystal crystals[] = {
    {"lattices.bcc", {{0, 0, 0}, {0.5, 0.5, 0.5}}, {0.75, 1}, {1, 2.0 / 3}, 4.0 / 7},
    {"lattices.fcc",
     {{0, 0, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}, {0.5, 0.5, 0}},
     {0.5, 1},
     {1, 0.25},
     1.0 / 6},
};

class Centred : public testing::TestWithParam<Crystal> {};
INSTANTIATE_TEST_SUITE_P(Lattices, Centred, testing::ValuesIn(crystals),
                         [](const auto& info) { return std::string(info.param.name).substr(9); });

LatticeGeometry geometry_of(const Crystal& crystal) {
  static Host host;
  return load_lattice(host, crystal.name);
}

Stages box(const Crystal& crystal, Vec3 high, const Keys& more = {}) {
  return stage(crystal.name, Keys{{"spacing", 1}, {"shape", test::box({}, high)}} + more);
}

std::vector<Vec3> places(const Body& body) {
  std::vector<Vec3> all;
  for (Particle p = 0; p < body.particles; ++p) all.push_back(body.position(p));
  return all;
}

TEST_P(Centred, ABoxOfCellsHoldsAllTheirParticles) {
  const BuiltScene built = build(box(GetParam(), {4, 3, 5}) + elastic());
  std::set<std::tuple<double, double, double>> found, expected;  // in quarters of a cell
  for (const Vec3 at : places(built->body))
    found.emplace(std::round(4 * at.x), std::round(4 * at.y), std::round(4 * at.z));
  for (int n = 0; n < 4 * 3 * 5; ++n)
    for (const Vec3 in : GetParam().cell) {
      const Vec3 at =
          Vec3{double(n % 4), double(n / 4 % 3), double(n / 12)} + in + Vec3{0.25, 0.25, 0.25};
      expected.emplace(4 * at.x, 4 * at.y, 4 * at.z);
    }
  EXPECT_EQ(built->body.particles, expected.size());
  EXPECT_EQ(found, expected);
  EXPECT_NEAR(built->mass(0), 1000.0 / static_cast<double>(GetParam().cell.size()), 1e-9);
}

TEST_P(Centred, AnyShapeIsFilledWithTheSitesInsideIt) {
  const Vec3 centre{0.3, -0.2, 0.1};
  for (const double radius : {1.3, 2.6}) {
    const Json shape = {{"sphere", {{"radius", radius}, {"centre", centre}}}};
    const BuiltScene built =
        build(stage(GetParam().name, {{"spacing", 1}, {"anchor", {0.1, 0, 0}}, {"shape", shape}}) +
              elastic());
    std::size_t expected = 0;
    for (int n = 0; n < 9 * 9 * 9; ++n)
      for (const Vec3 in : GetParam().cell) {
        const Vec3 at = Vec3{double(n % 9 - 4), double(n / 9 % 9 - 4), double(n / 81 - 4)} + in +
                        Vec3{0.35, 0.25, 0.25};
        if (norm(at - centre) <= radius) ++expected;
      }
    EXPECT_EQ(built->body.particles, expected);
    for (const Vec3 at : places(built->body)) EXPECT_LE(norm(at - centre), radius);
  }
}

TEST_P(Centred, SpringsJoinFirstAndSecondNeighbours) {
  const BuiltScene built = build(box(GetParam(), {3, 4, 3}) + elastic());
  const std::vector<Vec3> at = places(built->body);
  std::array<std::uint64_t, 2> pairs{};
  for (std::size_t a = 0; a < at.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      for (std::size_t c = 0; c < 2; ++c)
        if (std::abs(dot(at[a] - at[b], at[a] - at[b]) - GetParam().squares[c]) < 1e-9) ++pairs[c];
  EXPECT_EQ(built->body.springs[0], pairs[0]);
  EXPECT_EQ(built->body.springs[1], pairs[1]);
  for (const NeighbourGeometry& n : built->springs.neighbours)
    EXPECT_NEAR(n.rest_length * n.rest_length, GetParam().squares[n.site.spring_class], 1e-12);
  for (std::uint32_t c = 0; c < 2; ++c)
    EXPECT_NEAR(built->springs.spring(0, 0, c).stiffness,
                GetParam().base_stiffness[c] * built->materials[0].constants.base_stiffness, 1e-6);
}

TEST_P(Centred, FacesAreTheOutermostPlanes) {
  const BuiltScene built = build(box(GetParam(), {3, 4, 5}) + elastic() +
                                 stage("loads.fixed", {{"on", "y_max"}, {"axes", "y"}}));
  const std::size_t in_a_plane = 3 * 5 * GetParam().cell.size() / 2;
  ASSERT_EQ(built->loads[0].particles.size(), in_a_plane);
  for (const LoadedParticle& loaded : built->loads[0].particles)
    EXPECT_NEAR(built->body.position(loaded.particle).y, 3.75, 1e-12);
}

TEST_P(Centred, PressureOnAFaceHasTheRightTotal) {
  const BuiltScene built = build(box(GetParam(), {3, 4, 5}) + elastic() +
                                 stage("loads.pressure", {{"on", "x_max"}, {"pressure", 2}}) +
                                 stage("loads.fixed", {{"on", "surface"}}));
  Vec3 total;
  for (const LoadedParticle& loaded : built->loads[0].particles) total = total + loaded.force;
  EXPECT_NEAR(total.x, -2 * 4 * 5, 1e-9);
  EXPECT_NEAR(norm(total), 2 * 4 * 5, 1e-9);
  // The loaded particles are at most one spacing from a face.
  for (const LoadedParticle& loaded : built->loads[1].particles) {
    const Vec3 x = built->body.position(loaded.particle);
    EXPECT_LT(std::min({x.x, x.y, x.z, 3 - x.x, 4 - x.y, 5 - x.z}), 1);
  }
}

TEST_P(Centred, SaysWhatItCannotDo) {
  const auto expect = [](const std::string& faults, const char* pointer, const char* part) {
    EXPECT_NE(faults.find(pointer), std::string::npos) << faults;
    EXPECT_NE(faults.find(part), std::string::npos) << faults;
  };
  expect(faults_of(box(GetParam(), {3, 3, 3}, {{"boundary", "cells"}}) + elastic()),
         "/pipeline/0/boundary", "particles");
  expect(faults_of(box(GetParam(), {0.1, 3, 3}) + elastic()), "/pipeline/0", "is inside the shape");
}

/// C11, C12, C44 and the part of the height for one layer, k = 1. The sums run over all springs of
/// a crystal at one of its particles.
struct Sums {
  double xxxx = 0, xxyy = 0, xxww = 0, wwww = 0;

  Sums(const Crystal& crystal, const Ratios& r) {
    const double cross[2] = {r.beta, r.gamma};
    wwww = r.alpha / 2;
    for (int n = 0; n < 125; ++n)
      for (const Vec3 in : crystal.cell) {
        const Vec3 to = Vec3{double(n % 5 - 2), double(n / 5 % 5 - 2), double(n / 25 - 2)} + in;
        for (std::size_t c = 0; c < 2; ++c) {
          if (std::abs(dot(to, to) - crystal.squares[c]) > 1e-9) continue;
          const double base = crystal.base_stiffness[c] / crystal.squares[c] / 2,
                       k = cross[c] / (crystal.squares[c] + 1) / 2;  // each end counts half
          xxxx += (base + k) * std::pow(to.x, 4);
          xxyy += (base + k) * to.x * to.x * to.y * to.y;
          xxww += k * to.x * to.x;
          wwww += k;
        }
      }
    const double volume = 1 / static_cast<double>(crystal.cell.size());
    for (double* sum : {&xxxx, &xxyy, &xxww, &wwww}) *sum /= volume;
  }
  double relaxed(bool clamped) const { return clamped || wwww == 0 ? 0 : xxww * xxww / wwww; }
};

TEST_P(Centred, ElasticityIsTheSumOverItsSprings) {
  const LatticeGeometry geometry = geometry_of(GetParam());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> ratio(-0.5, 3);
  for (int n = 0; n < 50; ++n) {
    const Ratios r{ratio(random), ratio(random), ratio(random), n % 3 == 0};
    const LatticeElasticity e = elasticity(with_ratios(geometry, r));
    const Sums sums(GetParam(), r);
    const double relaxed = sums.relaxed(r.clamped), tolerance = 1e-10 * (1 + std::abs(relaxed));
    EXPECT_NEAR(e.C11, sums.xxxx - relaxed, tolerance);
    EXPECT_NEAR(e.C12, sums.xxyy - relaxed, tolerance);
    EXPECT_NEAR(e.C44, sums.xxyy, tolerance);
    EXPECT_TRUE(e.cubic);
  }
}

TEST_P(Centred, IsIsotropicAloneAndWithMembraneIm) {
  const LatticeGeometry geometry = geometry_of(GetParam());
  EXPECT_TRUE(elasticity(with_ratios(geometry, {})).isotropic);
  EXPECT_NEAR(elasticity(with_ratios(geometry, {})).poisson_bulk(), 0.25, 1e-14);
  for (const double poisson : {0.2, 0.1, 0.0, -0.1}) {
    const double lambda = *lambda_for(geometry, Membrane::I_m, poisson);
    const Ratios r = ratios_of(geometry, Membrane::I_m, lambda);
    EXPECT_NEAR(r.gamma / r.beta, GetParam().isotropic, 1e-12);
    const LatticeElasticity e = elasticity(with_ratios(geometry, r));
    EXPECT_NEAR(e.poisson_bulk(), poisson, 1e-12);
    EXPECT_TRUE(e.isotropic);
    EXPECT_FALSE(find_instability(with_ratios(geometry, r).endless(), Sector::mirrored));
  }
  EXPECT_FALSE(elasticity(with_ratios(geometry, ratios_of(geometry, Membrane::II, 1))).isotropic);
}

TEST_P(Centred, MaterialsGetTheModulusAndThePoissonRatioThatTheyAskFor) {
  for (const auto& [membrane, poisson] : {std::pair{"I-m", 0.1}, {"I", 0.15}, {"IV", 0.2}}) {
    const BuiltScene built =
        build(box(GetParam(), {3, 3, 3}) + elastic({{"membrane", membrane}, {"poisson", poisson}}));
    const MaterialConstants& found = built->materials[0].constants;
    const Ratios r{found.alpha_ratio, found.cross_ratio[0], found.cross_ratio[1], found.clamped};
    const Sums sums(GetParam(), r);
    const double k = found.base_stiffness, C11 = k * (sums.xxxx - sums.relaxed(r.clamped)),
                 C12 = k * (sums.xxyy - sums.relaxed(r.clamped));
    EXPECT_NEAR(C12 / (C11 + C12), poisson, 1e-6) << membrane;
    EXPECT_NEAR((C11 - C12) * (C11 + 2 * C12) / (C11 + C12), 1e9, 1) << membrane;
  }
}

// In an infinite isotropic lattice of central springs, equation (15) is exact. A finite body has
// fewer springs, so that the equation gives a larger k.
TEST_P(Centred, EquationFifteenUsesTheSpringsThatExist) {
  const auto stiffness = [&](const Keys& how) {
    return build(box(GetParam(), {6, 6, 6}) + elastic(how))->materials[0].constants.base_stiffness;
  };
  const BuiltScene built = build(box(GetParam(), {6, 6, 6}) + elastic());
  double squares = 0;
  for (std::size_t c = 0; c < 2; ++c)
    squares += GetParam().base_stiffness[c] * GetParam().squares[c] *
               static_cast<double>(built->body.springs[c]);
  EXPECT_NEAR(stiffness({{"stiffness", "eq15"}}), 6 * 216 * 1e9 / squares, 1);
  // `whole` is the sum of l^2 over the springs per particle in a large body.
  const double bulk = stiffness({{"stiffness", "bulk"}}),
               whole = GetParam().cell.size() == 2 ? 3 + 2 : 3 + 0.75;
  EXPECT_NEAR(bulk, 6 * 1e9 / whole / static_cast<double>(GetParam().cell.size()), 1);
}

TEST_P(Centred, SaysWhichPoissonRatiosAMembraneReaches) {
  const auto faults = [&](const Keys& material) {
    return faults_of(box(GetParam(), {3, 3, 3}) + elastic(material));
  };
  const std::string beyond = faults({{"membrane", "I-m"}, {"poisson", 0.3}});
  EXPECT_NE(beyond.find("/pipeline/1/poisson"), std::string::npos) << beyond;
  EXPECT_NE(beyond.find(", 0.25], the reach of membrane I-m; 0.3 is within the reach of"),
            std::string::npos)
      << beyond;
  EXPECT_NE(faults({{"poisson", 0.2}}).find("0.25, or left out"), std::string::npos);
  EXPECT_NE(faults({{"membrane", "I-m"}, {"poisson", 0.1}, {"parameters", "paper"}})
                .find("/pipeline/1/parameters"),
            std::string::npos);
  EXPECT_NE(faults({{"membrane", "I-m"}, {"lambda", -1}}).find("/pipeline/1/lambda"),
            std::string::npos);
}

/// Squared frequencies times m along [100] without a membrane, summed by hand: one longitudinal
/// wave and two transverse waves.
TEST_P(Centred, WavesAlongAnAxis) {
  const LatticeGeometry geometry = geometry_of(GetParam());
  const SpringLattice lattice = with_ratios(geometry, {});
  const bool body = GetParam().cell.size() == 2;
  for (const double q : {0.1, 1.0, 2.5, 4.0, 2 * std::numbers::pi}) {
    const double first = 1 - std::cos(q / 2), second = 1 - std::cos(q),
                 k2 = GetParam().base_stiffness[1];
    const double transverse = (body ? 8.0 / 3 : 2.0) * first,
                 longitudinal = (body ? 8.0 / 3 : 4.0) * first + 2 * k2 * second;
    std::vector<double> expected{transverse, transverse, longitudinal};
    std::sort(expected.begin(), expected.end());
    const std::vector<Wave> found = waves(lattice.endless(), {q, 0, 0}, Sector::mirrored);
    ASSERT_EQ(found.size(), 3u);
    for (std::size_t mode = 0; mode < 3; ++mode)
      EXPECT_NEAR(found[mode].stiffness, expected[mode], 1e-12) << q;
  }
}

// The search over the zone must find a wave at least as stiff as all random wave vectors do.
TEST_P(Centred, TheStiffestWaveIsTheStiffestOfAll) {
  const LatticeGeometry geometry = geometry_of(GetParam());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(-2 * std::numbers::pi, 2 * std::numbers::pi),
      ratio(0, 3);
  for (int n = 0; n < 10; ++n) {
    const SpringLattice lattice =
        with_ratios(geometry, {ratio(random), ratio(random), ratio(random), n % 2 == 0});
    double stiffest = 0;
    for (int sample = 0; sample < 5000; ++sample)
      stiffest = std::max(
          stiffest, stiffness_range(lattice.endless(),
                                    {angle(random), angle(random), angle(random)}, Sector::mirrored)
                        .stiffest);
    const double found = stiffest_wave(lattice.endless()).stiffness;
    EXPECT_LE(stiffest, found * (1 + 1e-9));
    EXPECT_GE(stiffest, 0.95 * found);
  }
}

// The measured elasticity of a cube approaches that of the infinite lattice as the cube grows.
TEST_P(Centred, AMeasuredCubeApproachesTheEndlessLattice) {
  Host host;
  const LatticeGeometry geometry = geometry_of(GetParam());
  const Ratios r = ratios_of(geometry, Membrane::I_m, *lambda_for(geometry, Membrane::I_m, 0.1));
  const double young = elasticity(with_ratios(geometry, r)).young();
  std::vector<double> poisson, modulus;
  for (const int cells : {4, 8, 16}) {
    VirtualTest::Options options;
    options.lattice = GetParam().name;
    options.particles = cells;
    // The cube is pulled, because some particles at the edges of fcc would buckle under pressure.
    options.strain = -1e-6;
    const VirtualTestResult measured = test::virtual_test(host, options).measure(r);
    poisson.push_back(measured.poisson - 0.1);
    modulus.push_back(measured.young / young - 1);
  }
  for (std::size_t n = 1; n < modulus.size(); ++n) EXPECT_NEAR(modulus[n - 1] / modulus[n], 2, 0.3);
  EXPECT_LT(std::abs(modulus.back()), 0.07);
  EXPECT_LT(std::abs(poisson.back()), 0.005);
  EXPECT_LT(std::abs(poisson.back()), std::abs(poisson.front()));
}

}  // namespace centred_lattices_test
