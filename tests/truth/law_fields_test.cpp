// Fields that laws of materials give, of the program and of somebody else's plugin: closed forms
// for a body under homogeneous strain, names in scenes, and names with two meanings.
#include <plan/fields.hpp>
#include <run/snapshot.hpp>
#include <support/scenes.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace law_fields_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr double young = 1e10, yield = 1e7, yield_strain = yield / young, strain = 4e-3;

Keys solid(const Keys& more) {
  return Keys{{"young", young}, {"density", 2500}, {"poisson", 0.25}, {"membrane", "none"}} + more;
}
const Keys plastic = solid({{"yield", yield}}), slipping = solid({{"strain", yield_strain}});

/// A scene of a box of 7 x 5 x 5 particles, 1 mm apart, with the plugins of the tests.
SceneBuilder bar(const Stages& stages) {
  return SceneBuilder{}
      .key("plugins", {HYPERLATTICE_BUILD "/tests/test_laws"})
      .lattice("lattices.cubic", 1e-3, box_mm(7, 5, 5))
      .stages(stages)
      .solver("solvers.explicit", {{"end_time", 1e-6}});
}

/// A body stretched along x in one step, so that its springs have yielded once.
struct Stretched {
  std::unique_ptr<Plan> plan;
  Simulation simulation;
  SnapshotSource source;

  explicit Stretched(const std::string& scene, int threads = 1)
      : plan(plan_of(scene, threads)),
        simulation(*plan->model, threads),
        source(*plan->model, simulation) {
    const Body& body = plan->model->body;
    std::vector<double> u(3 * body.particles, 0);
    for (Particle p = 0; p < body.particles; ++p) u[3 * p] = strain * body.position(p).x;
    simulation.set_displacements(u, {});
    simulation.step(1e-15);
  }
  std::vector<double> field(std::string_view name) {
    Field field;
    EXPECT_TRUE(source.take().field(name, field)) << name;
    EXPECT_EQ(field.components, 1u);
    return {field.values.begin(), field.values.end()};
  }
  double at(std::string_view name, Site site) { return field(name).at(plan->model->body.at(site)); }
};

/// Strains of the springs along x, and of those along the diagonals with a part along x.
constexpr double along = strain;
double diagonal() {
  return (std::hypot(1 + strain, 1) - std::numbers::sqrt2) / std::numbers::sqrt2;
}

/// An inner particle has 18 springs, two along x and eight along such diagonals. A diagonal
/// yields at the elastic strain e (1 - nu) / 2 of a bar along x under the strain e.
TEST(LawFields, PlasticStrainOfABarUnderHomogeneousStrain) {
  Stretched body(bar(stage("materials.plastic", plastic)).text());
  const double expected =
      (2 * (along - yield_strain) + 8 * (diagonal() - yield_strain * (1 - 0.25) / 2)) / 18;
  EXPECT_NEAR(body.at("plastic_strain", {3, 2, 2}), expected, 1e-9 * expected);
  EXPECT_NEAR(body.at("equivalent_plastic_strain", {3, 2, 2}), expected, 1e-9 * expected);
  // A corner has one spring along x, two such diagonals, and three springs without a part along x.
  const double corner =
      ((along - yield_strain) + 2 * (diagonal() - yield_strain * (1 - 0.25) / 2)) / 6;
  EXPECT_NEAR(body.at("plastic_strain", {0, 0, 0}), corner, 1e-9 * corner);
}

TEST(LawFields, HaveTheSameBitsForAnyNumberOfThreads) {
  const std::string scene = bar(stage("materials.plastic", plastic)).text();
  EXPECT_EQ(Stretched(scene, 1).field("plastic_strain"),
            Stretched(scene, 3).field("plastic_strain"));
}

TEST(LawFields, APluginOutsideOfTheProgramGivesItsOwn) {
  Stretched body(bar(stage("materials.slipping", slipping)).text());
  const double expected =
      1e-3 * (2 * (along - yield_strain) + 8 * std::numbers::sqrt2 * (diagonal() - yield_strain)) /
      18;
  EXPECT_NEAR(body.at("slip", {3, 2, 2}), expected, 1e-9 * expected);
  const std::vector<std::string_view> all = fields_of(*body.plan->model);
  EXPECT_NE(std::find(all.begin(), all.end(), "slip"), all.end());
  Field none;
  EXPECT_FALSE(body.source.take().field("slipped", none));
}

/// Two materials in one body: a particle has the mean over its springs of the law, and one without
/// such springs has no number. A spring between the materials counts by its half of that law.
TEST(LawFields, BelongToTheSpringsOfTheirLaw) {
  Stretched body(bar(stage("materials.elastic", solid({})) +
                     stage("materials.slipping",
                           slipping + Keys{{"region", box({3.5e-3, -1, -1}, {1, 1, 1})}}))
                     .text());
  EXPECT_TRUE(std::isnan(body.at("slip", {1, 2, 2})));
  const double expected =
      1e-3 * (2 * (along - yield_strain) + 8 * std::numbers::sqrt2 * (diagonal() - yield_strain)) /
      18;
  EXPECT_NEAR(body.at("slip", {5, 2, 2}), expected, 1e-9 * expected);
  EXPECT_GT(body.at("slip", {4, 2, 2}), 0);
  EXPECT_TRUE(std::isfinite(body.at("slip", {3, 2, 2})));
}

/// Returns the faults of a scene; empty if it can be planned.
std::string faults_of_scene(const Stages& stages) {
  try {
    plan_of(bar(stages).text());
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(LawFields, OutputsNameThemAsAnyField) {
  const Stages material = stage("materials.slipping", slipping);
  EXPECT_EQ(faults_of_scene(
                material + stage("writers.vtu", {{"fields", {"slip"}}}) +
                stage("writers.csv", {{"fields", {"displacement", "slip"}}}) +
                stage("writers.picture", {{"colour_by", "slip"}, {"width", 64}, {"height", 64}}) +
                stage("probes.region", {{"field", "slip"}})),
            "");
  EXPECT_NE(faults_of_scene(material + stage("writers.vtu", {{"fields", {"slop"}}}))
                .find("did you mean \"slip\"?"),
            std::string::npos);
  EXPECT_NE(
      faults_of_scene(material + stage("probes.region", {{"field", "slip"}, {"component", "x"}}))
          .find("no component, because \"slip\" is a single number"),
      std::string::npos);
  EXPECT_NE(faults_of_scene(stage("materials.elastic", solid({})) +
                            stage("writers.vtu", {{"fields", {"slip"}}}))
                .find("or a field that a material of the scene declares"),
            std::string::npos);
}

TEST(LawFields, ANameHasOneMeaning) {
  const std::string faults = faults_of_scene(
      stage("materials.plastic", plastic) +
      stage("materials.slipping", slipping + Keys{{"region", box({2e-3, -1, -1}, {1, 1, 1})}}));
  EXPECT_NE(faults.find("/pipeline/2/type: \"materials.slipping\": expected a material whose field "
                        "\"plastic_strain\" means the same as that of materials.plastic"),
            std::string::npos)
      << faults;
}

}  // namespace law_fields_test
