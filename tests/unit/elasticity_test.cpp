// Elasticity from the neighbours of a lattice, against the closed forms of the cubic lattice, an
// independent table, and other lattices.
#include <analyze/crystals.hpp>
#include <analyze/dispersion.hpp>
#include <analyze/elasticity.hpp>
#include <analyze/membranes.hpp>
#include <model/stability.hpp>

#include <gtest/gtest.h>

#include <fstream>
#include <numbers>
#include <random>
#include <sstream>

namespace elasticity_test {
using namespace hyperlattice;
using calibration::Membrane;
using calibration::Ratios;

constexpr Membrane with_lambda[] = {Membrane::I, Membrane::II, Membrane::III, Membrane::IV,
                                    Membrane::I_m};

/// A lattice with these forward neighbours. The longer springs are of class 1.
LatticeGeometry lattice_of(const std::vector<std::array<int, 3>>& forward, double spacing,
                           double site_volume, double membrane_distance) {
  std::vector<Neighbour> neighbours;
  for (const auto& [x, y, z] : forward)
    neighbours.push_back({x, y, z,
                          x * x + y * y + z * z > forward[0][0] * forward[0][0] +
                                                      forward[0][1] * forward[0][1] +
                                                      forward[0][2] * forward[0][2]
                              ? 1u
                              : 0u});
  Grid grid;
  grid.spacing = spacing;
  grid.site_volume = site_volume;
  grid.membrane_distance = membrane_distance;
  grid.neighbours = neighbours;
  grid.spring_classes = 2;
  return geometry_from(grid);
}

LatticeGeometry cubic(double l = 1) {
  return lattice_of({{1, 0, 0},
                     {-1, 1, 0},
                     {0, 1, 0},
                     {1, 1, 0},
                     {0, -1, 1},
                     {-1, 0, 1},
                     {0, 0, 1},
                     {1, 0, 1},
                     {0, 1, 1}},
                    l, l * l * l, l);
}

TEST(Elasticity, IsThatOfTheClosedFormsForAnyMixture) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> ratio(-4, 5);
  for (int n = 0; n < 200; ++n) {
    const Ratios r{ratio(random), ratio(random), ratio(random), n % 4 == 0};
    const LatticeElasticity e = elasticity(with_ratios(cubic(0.02), r));
    const calibration::Elasticity expected = calibration::elasticity(r);
    EXPECT_NEAR(e.C1, expected.C1, 1e-12);
    EXPECT_NEAR(e.C2, expected.C2, 1e-12);
    EXPECT_NEAR(e.C3, expected.C3 - (r.clamped ? r.alpha : 0), 1e-12);
    EXPECT_NEAR(e.C4, expected.C4, 1e-12);
    const double tolerance = 1e-10 * (1 + std::abs(expected.D1));
    EXPECT_NEAR(e.C11, expected.D1 / 2, tolerance);
    EXPECT_NEAR(e.C12, expected.D2 / 2, tolerance);
    EXPECT_NEAR(e.C44, expected.D3 / 2, tolerance);
    EXPECT_NEAR(e.poisson_shear(), expected.poisson_shear(),
                1e-6 * (1 + std::abs(expected.poisson_shear())));
    EXPECT_TRUE(e.cubic);
    EXPECT_FALSE(e.isotropic);
  }
}

TEST(Elasticity, AgreesWithTheTableOfTheFiveMembranes) {
  std::ifstream file(std::string(HYPERLATTICE_SOURCE) + "/tests/data/nu_eta_table.csv");
  std::string line;
  std::getline(file, line);
  ASSERT_TRUE(line.starts_with("lattice,lambda,nu_inf,nu2_inf,eta_inf,A_inf,"));
  int rows = 0;
  for (; std::getline(file, line); ++rows) {
    std::stringstream cells(line);
    std::string name, lambda, nu, nu2, eta, zener;
    for (std::string* cell : {&name, &lambda, &nu, &nu2, &eta, &zener})
      std::getline(cells, *cell, ',');
    const auto found = std::find(std::begin(calibration::membrane_names),
                                 std::end(calibration::membrane_names), name);
    const Membrane membrane =
        static_cast<Membrane>(found - std::begin(calibration::membrane_names));
    const LatticeElasticity e =
        elasticity(with_ratios(cubic(), calibration::ratios(membrane, std::stod(lambda))));
    EXPECT_NEAR(e.poisson_bulk(), std::stod(nu), 1e-6) << line;
    EXPECT_NEAR(e.poisson_shear(), std::stod(nu2), 1e-6) << line;
    EXPECT_NEAR(e.young() / 2.5, std::stod(eta), 1e-6) << line;
    EXPECT_NEAR(e.zener(), std::stod(zener), 1e-6) << line;
    EXPECT_EQ(e.isotropic, membrane == Membrane::I_m || std::stod(lambda) == 0) << line;
  }
  EXPECT_EQ(rows, 98);
}

// C1 and C4 for a membrane distance Delta that differs from the spacing: equation (27) with Delta
// as a variable.
TEST(Elasticity, KnowsTheThicknessOfTheMembrane) {
  const double l = 2, D = 0.7, kb = 1.3, kg = 0.4, ka = 0.9;
  LatticeGeometry geometry = cubic(l);
  geometry.membrane_distance = D;
  for (NeighbourGeometry& n : geometry.neighbours)
    n.cross_rest_length = std::hypot(n.rest_length, D);
  const LatticeElasticity e = elasticity(with_ratios(geometry, {ka, kb, kg, false}));
  const double b = l * l + D * D, g = 2 * l * l + D * D;
  EXPECT_NEAR(e.C1, 6 + 2 * kb * l * l / b + 8 * kg * l * l / g, 1e-12);
  EXPECT_NEAR(e.C4, 2 * kb * D * D / b + 8 * kg * D * D / g, 1e-12);
  EXPECT_NEAR(e.C3,
              (ka * D * D + 6 * kb * D * D * D * D / b + 12 * kg * D * D * D * D / g) / (l * l),
              1e-12);
}

// Central springs to the nearest neighbours of the face-centred lattice: C11 = 2 C12 = 2 C44 = 2 k
// / a (textbook), with a = 2 spacings.
TEST(Elasticity, OfTheFaceCentredLattice) {
  const LatticeGeometry fcc = lattice_of(
      {{1, 1, 0}, {-1, 1, 0}, {1, 0, 1}, {-1, 0, 1}, {0, 1, 1}, {0, -1, 1}}, 0.5, 0.25, 0.5);
  const LatticeElasticity e = elasticity(with_ratios(fcc, {}));
  const double a_over_spacing = 2;  // elastic constants are in units of k / spacing
  EXPECT_NEAR(e.C11 * a_over_spacing, 2, 1e-12);
  EXPECT_NEAR(e.C12 * a_over_spacing, 1, 1e-12);
  EXPECT_NEAR(e.C44 * a_over_spacing, 1, 1e-12);
  EXPECT_TRUE(e.cubic);
  EXPECT_FALSE(e.isotropic);
  EXPECT_FALSE(find_instability(with_ratios(fcc, {}).endless(), Sector::mirrored));
}

// In the body-centred lattice with nearest neighbours alone, C11 = C12 and [110] shear has no
// stiffness. Second neighbours of stiffness 1 make the lattice stable.
TEST(Elasticity, OfTheBodyCentredLattice) {
  const std::vector<std::array<int, 3>> nearest{{1, 1, 1}, {-1, 1, 1}, {1, -1, 1}, {-1, -1, 1}};
  const LatticeElasticity e = elasticity(with_ratios(lattice_of(nearest, 0.5, 0.5, 0.5), {}));
  EXPECT_NEAR(e.C11 * 2, 2.0 / 3 * 1, 1e-12);
  EXPECT_NEAR(e.C12, e.C11, 1e-12);
  EXPECT_NEAR(e.C44, e.C11, 1e-12);
  auto both = nearest;
  for (const std::array<int, 3> second : {std::array{2, 0, 0}, {0, 2, 0}, {0, 0, 2}})
    both.push_back(second);
  const SpringLattice stable = with_ratios(lattice_of(both, 0.5, 0.5, 0.5), {});
  EXPECT_GT(elasticity(stable).C11, elasticity(stable).C12);
  EXPECT_FALSE(find_instability(stable.endless(), Sector::mirrored));
}

TEST(Elasticity, SaysWhenALatticeIsNotCubic) {
  const LatticeElasticity e = elasticity(with_ratios(
      lattice_of({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {-1, 1, 0}}, 1, 1, 1), {}));
  EXPECT_FALSE(e.cubic);
  EXPECT_FALSE(e.isotropic);
  EXPECT_NEAR(e.stiffness[0][0], 2, 1e-12);
  EXPECT_NEAR(e.stiffness[2][2], 1, 1e-12);
}

TEST(Membranes, LambdaOfAPoissonRatioIsTheClosedForm) {
  for (const Membrane membrane : with_lambda) {
    const calibration::Reach reach = calibration::reach(membrane);
    for (const double share : {0.1, 0.4, 0.8}) {
      const double nu = reach.low + share * (reach.high - reach.low);
      const double expected = calibration::lambda(membrane, nu);
      EXPECT_NEAR(*lambda_for(cubic(), membrane, nu), expected, 1e-9 * (1 + std::abs(expected)));
    }
  }
  EXPECT_FALSE(lambda_for(cubic(), Membrane::free, 0.1));
  EXPECT_FALSE(lambda_for(cubic(), Membrane::none, 0.25));
}

TEST(Membranes, ReachIsFoundFromTheSpringsAlone) {
  for (const Membrane membrane : with_lambda) {
    const calibration::Reach expected = calibration::reach(membrane),
                             found = *reach(cubic(), membrane);
    EXPECT_NEAR(found.low, expected.low, 2e-5);
    EXPECT_NEAR(found.high, expected.high, 2e-5);
    EXPECT_EQ(found.open, expected.open);
  }
}

// Longitudinal waves: omega^2 = 12 sin^2(q/2); transverse waves: omega^2 = 4 sin^2(q/2).
TEST(Dispersion, IsExactAlongTheAxesWithoutAMembrane) {
  std::istringstream lines(dispersion_csv(with_ratios(cubic(), {}).endless(), 1));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line,
            "direction,q_x,q_y,q_z,mirrored_1,mirrored_2,mirrored_3,opposed_1,opposed_2,opposed_3");
  int rows = 0, along_x = 0;
  while (std::getline(lines, line)) {
    ++rows;
    if (!line.starts_with("100,")) continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream cells(line);
    double direction = 0, qx = 0, qy = 0, qz = 0, modes[6] = {};
    cells >> direction >> qx >> qy >> qz;
    for (double& mode : modes) cells >> mode;
    ASSERT_TRUE(cells);
    const double sine = std::sin(qx / 2);
    for (const int sector : {0, 3}) {
      EXPECT_NEAR(modes[sector], 2 * sine, 1e-7);
      EXPECT_NEAR(modes[sector + 1], 2 * sine, 1e-7);
      EXPECT_NEAR(modes[sector + 2], std::sqrt(12.0) * sine, 1e-7);
    }
    ++along_x;
  }
  EXPECT_EQ(rows, 303);
  EXPECT_EQ(along_x, 101);
}

// In long waves the height follows the strain. The slope of the longitudinal branch is then the
// speed of sound, sqrt(C11 / density), with the effective C11.
TEST(Dispersion, BeginsWithTheSpeedsOfSound) {
  for (const Membrane membrane : with_lambda) {
    const SpringLattice lattice = with_ratios(cubic(), calibration::ratios(membrane, 1.5));
    const LatticeElasticity e = elasticity(lattice);
    const double q = 1e-3;
    const std::vector<Wave> found = waves(lattice.endless(), {q, 0, 0}, Sector::mirrored);
    EXPECT_NEAR(found[0].stiffness / (q * q), e.C44, 1e-5);
    EXPECT_NEAR(found[2].stiffness / (q * q), e.C11, 1e-5);
  }
}

// Each stable lattice has the elastic constants of its crystal, and no wave in the zone grows.
TEST(Crystals, FitsHaveTheConstantsAndAreStable) {
  const auto crystals =
      read_crystals(std::string(HYPERLATTICE_SOURCE) + "/docs/theory/data/crystals.csv");
  ASSERT_EQ(crystals.size(), 116u);
  int fits = 0, mirrored = 0, two_layer = 0, by_criterion = 0;
  for (const Crystal& crystal : crystals) {
    by_criterion += crystal.C44 >= crystal.C12 ? 1 : 0;
    const auto found = fit(crystal);
    if (!found) continue;
    ++fits;
    const SpringLattice lattice = with_ratios(cubic(), found->ratios);
    const LatticeElasticity e = elasticity(lattice);
    EXPECT_NEAR(e.C11 * found->base_stiffness, crystal.C11, 1e-6 * crystal.C11) << crystal.name;
    EXPECT_NEAR(e.C12 * found->base_stiffness, crystal.C12, 1e-6 * crystal.C11) << crystal.name;
    EXPECT_NEAR(e.C44 * found->base_stiffness, crystal.C44, 1e-6 * crystal.C11) << crystal.name;
    EXPECT_GE(found->ratios.gamma, -4) << crystal.name;
    EXPECT_LE(found->ratios.alpha, 5) << crystal.name;
    EXPECT_EQ(!find_instability(lattice.endless(), Sector::mirrored), found->mirrored)
        << crystal.name;
    if (found->mirrored) {
      EXPECT_EQ(!find_instability(lattice.endless(), Sector::opposed), found->two_layer)
          << crystal.name;
      EXPECT_GE(crystal.C44, crystal.C12) << crystal.name;
    }
    mirrored += found->mirrored ? 1 : 0;
    two_layer += found->two_layer ? 1 : 0;
  }
  EXPECT_EQ(fits, 115);
  EXPECT_EQ(by_criterion, 38);
  EXPECT_EQ(mirrored, 36);
  EXPECT_GT(two_layer, 0);
}

// The fits are compared, crystal by crystal, with an independent computation.
TEST(Crystals, AreThoseThatWereFoundIndependently) {
  const std::string path = std::string(HYPERLATTICE_SOURCE) + "/docs/theory/data/crystals.csv";
  const auto crystals = read_crystals(path);
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  ASSERT_TRUE(
      line.starts_with("name,C11_GPa,C12_GPa,C44_GPa,nu1,nu2,Zener_A,reliability,in_display_range,"
                       "C44_ge_C12,hyperelastic_fit_in_box,mirror_"));
  for (std::size_t n = 0; n < crystals.size() && std::getline(file, line); ++n) {
    std::stringstream stream(line);
    std::vector<std::string> cells;
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    ASSERT_GE(cells.size(), 12u);
    const auto found = fit(crystals[n]);
    EXPECT_EQ(crystals[n].name, cells[0]);
    EXPECT_EQ(crystals[n].reliability, cells[7]);
    EXPECT_NEAR(crystals[n].poisson_bulk(), std::stod(cells[4]), 1e-4);
    EXPECT_NEAR(crystals[n].poisson_shear(), std::stod(cells[5]), 1e-4);
    EXPECT_EQ(found.has_value(), cells[10] == "1") << line;
    EXPECT_EQ(found && found->mirrored, cells[11] == "1") << line;
  }
}

TEST(Crystals, CauchysRelationNeedsAClampedMembrane) {
  Crystal crystal;
  crystal.C11 = 3;
  crystal.C12 = crystal.C44 = 1;
  const auto found = fit(crystal);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->two_layer);
  EXPECT_TRUE(found->ratios.clamped);
  EXPECT_NEAR(elasticity(with_ratios(cubic(), found->ratios)).poisson_bulk(), 0.25, 1e-12);
}

}  // namespace elasticity_test
