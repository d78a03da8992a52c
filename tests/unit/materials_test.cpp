// Several materials in a body: by region, with one law, and with springs between them. Also
// messages of the elastic material about values that it cannot reach.
#include <support/models.hpp>

#include <hyperlattice/calibration.hpp>

#include <gtest/gtest.h>

namespace materials_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

using Membrane = KernelChoice::Membrane;

const Keys in_left_half = {
    {"region", {{"half_space", {{"point", {3, 0, 0}}, {"normal", {1, 0, 0}}}}}}};
const Keys lattice_I_m = {{"membrane", "I-m"}, {"poisson", 0.1}};

Stages left_half(const Keys& more) { return elastic(more + in_left_half); }
std::string material_faults(const Keys& more) {
  return faults_of(box_lattice(4, 4, 4) + elastic(more));
}

void expect_in(const std::string& message, std::initializer_list<const char*> parts) {
  for (const char* part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
}

TEST(Materials, MembraneDecidesTheDegreesOfFreedom) {
  const auto choice = [](const Keys& more) {
    return build(box_lattice(4, 4, 4) + elastic(more))->springs.choice.membrane;
  };
  EXPECT_EQ(choice({{"membrane", "none"}}), Membrane::none);
  EXPECT_EQ(choice({{"membrane", "I-m"}, {"poisson", 0.25}}), Membrane::none);
  EXPECT_EQ(choice({{"membrane", "I-m"}, {"lambda", 0}}), Membrane::none);
  EXPECT_EQ(choice({{"membrane", "free"}, {"k_alpha", 1}}), Membrane::none);
  EXPECT_EQ(choice({{"membrane", "III"}, {"poisson", 0.2}}), Membrane::clamped);
  EXPECT_EQ(choice({{"membrane", "IV"}, {"poisson", 0.3}}), Membrane::clamped);
  EXPECT_EQ(choice({{"membrane", "free"}, {"k_alpha", "infinite"}, {"k_gamma", 1}}),
            Membrane::clamped);
  EXPECT_EQ(choice({{"membrane", "I-m"}, {"poisson", 0.1}}), Membrane::free);
  EXPECT_EQ(choice({{"membrane", "free"}, {"k_beta", 1}, {"k_gamma", 0.75}}), Membrane::free);
}

TEST(Materials, StiffnessMassAndStepOfLatticeIm) {
  const BuiltScene built = build(box_lattice(4, 4, 4) + elastic(lattice_I_m));
  const double k = 0.18939393939393939 * 1e9;  // values of figure 5
  EXPECT_NEAR(built->springs.spring(0, 0, 0).stiffness, k, 1e-6 * k);
  EXPECT_NEAR(built->springs.spring(0, 0, 0).cross_stiffness, 2.8 * k, 1e-6 * k);
  EXPECT_NEAR(built->springs.spring(0, 0, 1).cross_stiffness, 2.1 * k, 1e-6 * k);
  EXPECT_EQ(built->mass(0), 1000);
  EXPECT_NEAR(built->step_limit.time_step, 2 / std::sqrt(39.2 * k / 1000), 1e-9);
  EXPECT_EQ(built->degrees_of_freedom, 4);
}

// The sum of l^2 over the cube of N = 4 is 3 N^2 (N-1) + 12 N (N-1)^2; equation (15) is 6 V E over
// this sum.
TEST(Materials, EquationFifteenUsesTheSpringsThatExist) {
  const BuiltScene built =
      build(box_lattice(4, 4, 4) + elastic({{"poisson", 0.25}, {"stiffness", "eq15"}}));
  EXPECT_NEAR(built->springs.spring(0, 0, 0).stiffness, 6 * 64 * 1e9 / (3 * 16 * 3 + 12 * 4 * 9),
              1);
}

TEST(Materials, PapersPolynomials) {
  const BuiltScene built =
      build(box_lattice(4, 4, 4) + elastic(lattice_I_m + Keys{{"parameters", "paper"}}));
  const double lambda = calibration::paper_lambda(0.1);
  EXPECT_NEAR(built->materials[0].constants.cross_ratio[0], lambda, 1e-12);
  EXPECT_NEAR(built->springs.spring(0, 0, 0).stiffness,
              0.4e9 / calibration::paper_modulus_ratio(lambda), 1e-3);
}

TEST(Materials, LaterOnesTakeOver) {
  const BuiltScene built =
      build(box_lattice(6, 4, 4) + elastic() + left_half({{"poisson", 0.25}, {"name", "left"}}));
  ASSERT_EQ(built->kinds.material_of.size(), 96u);
  for (Particle p = 0; p < 96; ++p)
    EXPECT_EQ(built->kinds.material_of[p], built->body.site(p).i < 3 ? 1 : 0);
  EXPECT_GT(built->materials.size(), 1U);
}

TEST(Materials, SpringsBetweenMaterialsAreInSeries) {
  const BuiltScene built =
      build(box_lattice(6, 4, 4) + elastic(lattice_I_m) +
            left_half({{"young", 3e9},
                       {"density", 5000},
                       {"membrane", "I-m"},
                       {"poisson", 0.2},
                       {"failure", {{"type", "failures.elongation"}, {"limit", 0.01}}}}));
  for (std::uint32_t c = 0; c < 2; ++c) {
    const SpringConstants &a = built->springs.spring(0, 0, c), &b = built->springs.spring(1, 1, c),
                          &ab = built->springs.spring(0, 1, c),
                          &ba = built->springs.spring(1, 0, c);
    EXPECT_NEAR(1 / ab.stiffness, (1 / a.stiffness + 1 / b.stiffness) / 2, 1e-20);
    EXPECT_NEAR(1 / ab.cross_stiffness, (1 / a.cross_stiffness + 1 / b.cross_stiffness) / 2, 1e-20);
    EXPECT_EQ(ab.stiffness, ba.stiffness);
    EXPECT_EQ(a.alarm, infinity);
    // The half spring of b has the elongation of a whole one with the same force.
    EXPECT_NEAR(ab.stiffness * ab.alarm, b.stiffness * 0.01, 1e-9 * b.stiffness);
  }
  EXPECT_TRUE(built->springs.breakable);
  // The bound is safe and close: at most the smaller critical step of the two materials, and at
  // least 0.9 of it.
  const double smaller =
      std::min(built->materials[0].critical_time_step, built->materials[1].critical_time_step);
  EXPECT_LE(built->step_limit.time_step, smaller * (1 + 1e-12));
  EXPECT_GE(built->step_limit.time_step, 0.9 * smaller);
}

/// Largest omega^2 of a body by power iteration over its springs, with the height as the fourth
/// component. The iteration gives a lower bound.
double omega_square(const Model& model) {
  const std::size_t n = model.body.particles;
  std::vector<std::array<double, 4>> u(n);
  for (std::size_t p = 0; p < n; ++p)
    u[p] = {std::sin(3.7 * double(p)), std::cos(1.3 * double(p * p)), std::sin(0.7 + double(p)),
            std::cos(2.1 * double(p))};
  double value = 0;
  for (int iteration = 0; iteration < 400; ++iteration) {
    std::vector<std::array<double, 4>> f(n);
    for (std::size_t p = 0; p < n; ++p) {
      const std::uint8_t own = model.kinds.material_of[p];
      f[p][3] += 2 * model.materials[own].constants.alpha_ratio *
                 model.materials[own].constants.base_stiffness * u[p][3];
      const Site site = model.body.site(p);
      for (const NeighbourGeometry& g : model.springs.neighbours) {
        const Particle q =
            model.body.at({site.i + g.site.dx, site.j + g.site.dy, site.k + g.site.dz});
        if (q == Body::no_particle) continue;
        const SpringConstants& spring =
            model.springs.spring(own, model.kinds.material_of[q], g.site.spring_class);
        for (const auto& [k, length, delta] :
             {std::tuple{spring.stiffness, g.rest_length, 0.0},
              {spring.cross_stiffness, g.cross_rest_length, model.body.grid.membrane_distance}}) {
          const std::array<double, 4> here{-g.rest.x / length, -g.rest.y / length,
                                           -g.rest.z / length, delta / length};
          const std::array<double, 4> there{-here[0], -here[1], -here[2], here[3]};
          double elongation = 0;
          for (std::size_t c = 0; c < 4; ++c) elongation += here[c] * u[p][c] + there[c] * u[q][c];
          for (std::size_t c = 0; c < 4; ++c) {
            f[p][c] += k * elongation * here[c];
            f[q][c] += k * elongation * there[c];
          }
        }
      }
    }
    double uf = 0, uu = 0, norm = 0;
    for (std::size_t p = 0; p < n; ++p)
      for (std::size_t c = 0; c < 4; ++c) {
        const double m = model.mass(p);
        uf += u[p][c] * f[p][c];
        uu += u[p][c] * m * u[p][c];
        f[p][c] /= m;
        norm += f[p][c] * f[p][c];
      }
    value = uf / uu;
    for (std::size_t p = 0; p < n; ++p)
      for (std::size_t c = 0; c < 4; ++c) u[p][c] = f[p][c] / std::sqrt(norm);
  }
  return value;
}

TEST(Materials, CriticalStepOfSeveralIsSafeForTheBodyItself) {
  const std::pair<Keys, Keys> cases[] = {
      {{{"membrane", "I-m"}, {"poisson", 0.1}}, {{"poisson", 0.25}}},
      {{{"membrane", "I-m"}, {"poisson", 0.05}}, {{"membrane", "I-m"}, {"poisson", 0.22}}},
      {{{"membrane", "II"}, {"poisson", 0.0}}, {{"membrane", "I"}, {"poisson", 0.2}}}};
  for (const auto& [right, left] : cases) {
    const BuiltScene built = build(box_lattice(8, 6, 6) + elastic(right) + left_half(left));
    const double bound = 4 / (built->step_limit.time_step * built->step_limit.time_step),
                 found = omega_square(*built);
    EXPECT_LE(found, bound);
    EXPECT_GE(found, 0.8 * bound);
  }
}

TEST(Materials, WithoutAMembraneBesideOneThatMovesHeightsAreHeld) {
  const BuiltScene built =
      build(box_lattice(6, 4, 4) + elastic(lattice_I_m) + left_half({{"poisson", 0.25}}));
  EXPECT_EQ(built->springs.choice.membrane, Membrane::free);
  EXPECT_EQ(built->springs.spring(0, 1, 0).cross_stiffness, 0);
  EXPECT_NEAR(built->materials[1].constants.alpha_ratio, 6, 1e-12);
  EXPECT_NEAR(built->materials[1].critical_time_step, 2 / std::sqrt(12 * 0.4e9 / 1000),
              1e-9);  // as without a membrane
}

TEST(Materials, FaultsOfABodyOfSeveral) {
  const Stages lattice = box_lattice(6, 4, 4);
  expect_in(faults_of(lattice + left_half({{"poisson", 0.25}})),
            {"/pipeline: ", "48 have none", "(3.5, 0.5, 0.5)"});
  expect_in(faults_of(lattice + left_half({{"poisson", 0.25}}) + elastic()),
            {"/pipeline/1/region", "take all of this one's"});
  expect_in(faults_of(lattice + elastic() + elastic({{"region", {{"sphere", {{"radius", 0.1}}}}}})),
            {"/pipeline/2/region", "a sphere", "holds none"});
  expect_in(
      faults_of(lattice + elastic(lattice_I_m) + left_half({{"membrane", "IV"}, {"poisson", 0.3}})),
      {"/pipeline/2", "clamped and free"});
}

TEST(Elastic, SaysWhichPoissonRatiosAMembraneReaches) {
  expect_in(material_faults({{"membrane", "I-m"}, {"poisson", 0.3}}),
            {"/pipeline/1/poisson", "0.3", "(-0.2, 0.25]", "membrane I-m",
             "0.3 is within the reach of IV (not isotropic)"});
  expect_in(material_faults({{"membrane", "IV"}, {"poisson", -0.3}}),
            {"/pipeline/1/poisson", "-0.3 is within the reach of II"});
  expect_in(material_faults({{"membrane", "I"}, {"poisson", 0.4}}),
            {"/pipeline/1/poisson", "; membrane none reaches it"});
  expect_in(material_faults({{"membrane", "II"}, {"poisson", 0.2501}}),
            {"is within the reach of III, IV; membrane none reaches it too"});
  expect_in(material_faults({{"poisson", -0.6}}),
            {"has; volumetric true reaches it, in a body without failure"});
  expect_in(material_faults({{"membrane", "I-m"}, {"poisson", -0.6}}),
            {"membrane none with volumetric true reaches it"});
  expect_in(material_faults({{"poisson", 0.49999999999999994}}),
            {"/pipeline/1/poisson", "at most 0.499999"});
  expect_in(material_faults({{"poisson", 0.2}}), {"/pipeline/1/poisson", "0.25, or left out",
                                                  "I-m, I (not isotropic), II (not isotropic)"});
  expect_in(material_faults({{"membrane", "I-m"}, {"poisson", 0.02}, {"parameters", "paper"}}),
            {"/pipeline/1/poisson", "0.04 to 0.2464"});
}

TEST(Elastic, RefusesWhatDoesNotGoTogether) {
  expect_in(material_faults({{"membrane", "I-m"}}), {"/pipeline/1/poisson", "lambda"});
  expect_in(material_faults({{"membrane", "I-m"}, {"poisson", 0.1}, {"lambda", 1}}),
            {"/pipeline/1/lambda", "one of poisson and lambda"});
  expect_in(material_faults({{"lambda", 1}}), {"/pipeline/1/lambda"});
  expect_in(material_faults({{"membrane", "I"}, {"poisson", 0.1}, {"k_beta", 1}}),
            {"/pipeline/1/membrane", "free"});
  expect_in(material_faults({{"membrane", "IV"}, {"lambda", -2}}),
            {"/pipeline/1/lambda", "above -2"});
  expect_in(material_faults({{"membrane", "II"}, {"poisson", 0.1}, {"parameters", "paper"}}),
            {"/pipeline/1/parameters", "I-m"});
  expect_in(
      material_faults({{"membrane", "free"}, {"k_beta", 1}, {"k_gamma", 0.75}, {"poisson", 0.2}}),
      {"/pipeline/1", "leave poisson out"});
}

TEST(Elastic, AnUnstableMembraneIsRefusedWithItsWave) {
  expect_in(
      material_faults({{"membrane", "free"}, {"k_alpha", 3}, {"k_beta", -2.5}, {"k_gamma", 2}}),
      {"/pipeline/1", "stable lattice", "the wave with vector", "grows"});
  expect_in(
      material_faults({{"membrane", "free"}, {"k_beta", -1}, {"k_gamma", -0.2}, {"k_alpha", 0}}),
      {"homogeneous deformation"});
}

}  // namespace materials_test
