// Random lattices: their particles and springs, the elastic constants of their samples against an
// independent computation (tests/data/random_lattice.json), and whether the body has the E and nu
// that the scene asks for.
#include <analyze/calibrate.hpp>
#include <analyze/load_lattice.hpp>
#include <model/homogenise.hpp>
#include <support/lists.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>

namespace random_lattice_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

LatticeGeometry sample(const std::string& coordination) {
  Host host({std::string(HYPERLATTICE_BUILD) + "/lib/hyperlattice"});
  return load_lattice(host, "lattices.random", {"coordination=" + coordination});
}

nlohmann::json reference() {
  std::ifstream file(HYPERLATTICE_SOURCE "/tests/data/random_lattice.json");
  return nlohmann::json::parse(file);
}

/// E over the value of equation (14) for springs of stiffness k = 1 N/m.
double young_over_eq14(const LatticeGeometry& geometry, double young) {
  double squares = 0;
  for (const SampleSpring& spring : geometry.listed->sample)
    squares += dot(spring.rest, spring.rest);
  return young / (squares / (6 * geometry.listed->sample_volume));
}

TEST(RandomLattice, HasTheElasticConstantsThatOthersFound) {
  const std::map<std::string, LatticeGeometry> samples{{"8.4", sample("8.4")},
                                                       {"13.2", sample("13.2")}};
  int compared = 0;
  for (const auto& row : reference()) {
    if (row["lattice"] != "RSA d=0.82") continue;
    const double lambda = row["lam"];
    if (lambda != 0 && lambda != 1 && lambda != 7) continue;
    const LatticeGeometry& geometry = samples.at(row["LN"] < 10 ? "8.4" : "13.2");
    const calibration::Ratios ratios = calibration::ratios(calibration::Membrane::I, lambda);
    const ElasticConstants found =
        facts_of(geometry).elastic_constants(membranes::constants(facts_of(geometry), ratios));
    EXPECT_NEAR(found.poisson(), row["nu_num"], 0.012)
        << row["LN"] << " " << lambda;  // samples differ
    EXPECT_NEAR(young_over_eq14(geometry, found.young()), row["E_over_eq14"],
                0.04 * row["E_over_eq14"].get<double>())
        << row["LN"] << " " << lambda;
    EXPECT_NEAR(affine_pair(geometry, ratios)->poisson, row["nu_affine"], 0.006)
        << row["LN"] << " " << lambda;
    ++compared;
  }
  EXPECT_EQ(compared, 6);
}

TEST(RandomLattice, FewNeighboursGiveMoreThanAQuarter) {  // paper, section 2.4
  const ElasticPair few = elastic_pair(sample("8.4"), {}), many = elastic_pair(sample("13.2"), {});
  EXPECT_GT(few.poisson, 0.29);
  EXPECT_LT(few.poisson, 0.32);
  EXPECT_NEAR(many.poisson, 0.25, 0.02);
}

TEST(RandomLattice, HasWhatItsOptionsSay) {
  const auto plan =
      plan_of(listed_scene(random_lattice(8, 7, 9, {{"coordination", 10}, {"min_distance", 0.7}}),
                           {{"membrane", "none"}}));
  const Body& body = plan->model->body;
  EXPECT_EQ(body.particles, 8u * 7 * 9);
  EXPECT_EQ(body.listed.springs.size(), 5 * body.particles);
  double volume = 0;
  for (Particle p = 0; p < body.particles; ++p) {
    volume += body.share(p) * body.grid.site_volume;
    for (Particle q = 0; q < p; ++q) ASSERT_GE(norm(body.position(p) - body.position(q)), 0.7e-3);
  }
  EXPECT_NEAR(volume, 8e-3 * 7e-3 * 9e-3, 1e-12);
}

TEST(RandomLattice, WithTooFewSpringsToBeStiffIsWarnedOf) {
  const auto warnings = [](const std::string& coordination) {
    return plan_of(listed_scene(
                       random_lattice(6, 6, 6,
                                      {{"sample", 8}, {"coordination", std::stod(coordination)}}),
                       {{"membrane", "none"}}))
        ->model->warnings;
  };
  for (const char* none : {"5", "5.9"}) {  // the body has 216 particles
    const auto found = warnings(none);
    ASSERT_EQ(found.size(), 1u) << none;
    EXPECT_NE(found[0].find("the body's springs do not hold it"), std::string::npos) << found[0];
    EXPECT_NE(found[0].find("216 particles in space are held by 642 at least"), std::string::npos)
        << found[0];
  }
  for (const char* chance : {"6", "6.5", "6.9"}) {
    const auto found = warnings(chance);
    ASSERT_EQ(found.size(), 1u) << chance;
    EXPECT_NE(
        found[0].find("the body has " + std::string(chance) + " springs a particle on the mean"),
        std::string::npos)
        << found[0];
    EXPECT_NE(found[0].find("left to chance"), std::string::npos) << found[0];
  }
  for (const char* stiff : {"7", "8.4"}) EXPECT_TRUE(warnings(stiff).empty()) << stiff;
}

/// A listed lattice whose Poisson ratio tends to 2 / 3 for large lambda, and whose C12 / C11 at
/// lambda 0 is given.
LatticeFacts lattice_of(double* C12_over_C11) {
  LatticeFacts lattice;
  lattice.lengths = 1;
  lattice.self = C12_over_C11;
  lattice.get_elastic_constants = [](void* self, const MaterialConstants& constants) noexcept {
    const double lambda = constants.cross_ratio[0];
    return ElasticConstants{1 + lambda, *static_cast<const double*>(self) + 2 * lambda, 1};
  };
  lattice.get_stable = [](void*, const MaterialConstants& constants) noexcept {
    return constants.cross_ratio[0] >= 0;
  };
  return lattice;
}

TEST(RandomLattice, PoissonRatiosThatNoOptionTakesAreNotOffered) {
  double loose = 1.8, stiff = 0.5;
  const auto sentence = [](double& C12_over_C11) {
    return membranes::reach_sentence(lattice_of(&C12_over_C11), membranes::Membrane::I, 0.2);
  };
  const std::string none = sentence(loose);
  EXPECT_NE(none.find("none is possible with this lattice and membrane I, which gives (0.6429, "
                      "0.6667]; a Poisson ratio is below 0.5"),
            std::string::npos)
      << none;
  EXPECT_EQ(none.find("within"), std::string::npos) << none;
  EXPECT_EQ(sentence(stiff),
            "within (0.3333, 0.5), the reach of membrane I; other membranes have other ratios");
}

TEST(RandomLattice, AReachOfTooFewSpringsSaysWhy) {
  try {
    plan_of(listed_scene(random_lattice(6, 6, 6, {{"sample", 8}, {"coordination", 6}}),
                         {{"membrane", "none"}, {"poisson", 0.1}}));
    FAIL() << "a Poisson ratio that the lattice has not";
  } catch (const InputError& error) {
    EXPECT_NE(
        std::string(error.what())
            .find("The body has 6 springs a particle on the mean, too few to be stiff for certain"),
        std::string::npos)
        << error.what();
  }
}

TEST(RandomLattice, FillsAnyShapeAndOnlyIt) {
  const Json ball = {{"hollow_sphere", {{"inner_radius", "3 mm"}, {"outer_radius", "7 mm"}}}};
  const auto plan = plan_of(listed_scene(
      stage("lattices.random", {{"spacing", "1 mm"}, {"shape", ball}}), {{"membrane", "none"}},
      stage("loads.pressure", {{"on", "inner_surface"}, {"pressure", 1e6}})));
  const Body& body = plan->model->body;
  const double volume = 4.0 / 3 * 3.14159265358979 * (343 - 27);
  EXPECT_NEAR(static_cast<double>(body.particles), volume, 0.01 * volume);
  for (Particle p = 0; p < body.particles; ++p) {
    const double r = norm(body.position(p));
    ASSERT_GE(r, 3e-3);
    ASSERT_LE(r, 7e-3);
  }
  EXPECT_GT(plan->model->loads[0].particles.size(), 50u);
  for (const LoadedParticle& loaded : plan->model->loads[0].particles)
    EXPECT_LT(norm(body.position(loaded.particle)), 5e-3);
}

TEST(RandomLattice, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const auto positions = [](int seed) {
    return plan_of(listed_scene(random_lattice(5, 5, 5, {{"seed", seed}}), {{"membrane", "none"}}))
        ->model->body.listed.positions;
  };
  EXPECT_EQ(positions(3), positions(3));
  EXPECT_NE(positions(3), positions(4));
}

TEST(RandomLattice, GetsTheYoungsModulusAndThePoissonRatioOfItsScene) {
  const auto plan =
      plan_of(listed_scene(random_lattice(6, 6, 6), {{"membrane", "I"}, {"poisson", 0.2}}));
  const Model& model = *plan->model;
  const ElasticConstants own = homogenise(model.body.listed, 0, model.body.grid.membrane_distance,
                                          model.materials[0].constants);
  EXPECT_NEAR(own.poisson(), 0.2, 1e-7);
  EXPECT_NEAR(own.young(), 1e10, 1e4);
}

TEST(RandomLattice, PressureOnAFlatFaceHasTheRightTotal) {
  const auto plan =
      plan_of(listed_scene(random_lattice(6, 5, 7), {{"membrane", "none"}},
                           stage("loads.pressure", {{"on", "z_max"}, {"pressure", 2e6}})));
  Vec3 total;
  for (const LoadedParticle& loaded : plan->model->loads[0].particles) total = total + loaded.force;
  EXPECT_NEAR(total.z, -2e6 * 30e-6, 1e-6 * 60);
  EXPECT_NEAR(total.x, 0, 1e-9);
  EXPECT_NEAR(total.y, 0, 1e-9);
}

TEST(RandomLattice, WavesTravelAsFastAsItsModuliSay) {
  // One end of a long bar with free sides is pushed. The front travels with sqrt(E / rho), a little
  // slower because the surface is softer.
  const auto plan =
      plan_of(listed_scene(random_lattice(14, 14, 60), {{"membrane", "I"}, {"poisson", 0.2}},
                           stage("loads.velocity", {{"on", "z_min"}, {"value", {0, 0, 1e-3}}})));
  Simulation simulation(*plan->model, 2);
  const double speed = std::sqrt(1e10 / 2500), time = 40e-3 / speed;
  while (simulation.time() < time) simulation.step(0.9 * plan->model->step_limit.time_step);
  const std::vector<double> moved = displacements(simulation);
  const auto mean_at = [&](double low, double high) {
    double sum = 0, count = 0;
    for (Particle p = 0; p < plan->model->body.particles; ++p)
      if (const double z = plan->model->body.position(p).z; z > low && z < high) {
        sum += moved[3 * p + 2];
        ++count;
      }
    return sum / count;
  };
  const double all = 1e-3 * time;                       // displacement of the pushed end
  EXPECT_NEAR(mean_at(9e-3, 11e-3) / all, 0.75, 0.08);  // behind the front: 1 - z / 40 mm
  EXPECT_NEAR(mean_at(19e-3, 21e-3) / all, 0.5, 0.08);
  EXPECT_LT(mean_at(50e-3, 60e-3) / all, 0.01);
}

TEST(Points, RefusesWhatIsNoLattice) {
  const ListFiles files(3, 3, 3);
  const auto refusal = [&](const std::string& springs, const std::string& columns = "a,b") {
    std::ofstream(files.springs) << columns << "\n" << springs;
    try {
      plan_of(listed_scene(files.lattice(), {{"membrane", "none"}}));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string file = "file " + files.springs.string();
  EXPECT_NE(refusal("0,1\n1,2\n1,0\n")
                .find(file + ", line 4: expected a spring between points that no other joins; line "
                             "2 joins 0 and 1 too"),
            std::string::npos);
  EXPECT_NE(refusal("0,0\n").find(file + ", line 2: expected two points, not 0 twice"),
            std::string::npos);
  EXPECT_NE(
      refusal("0,1\n0,27\n")
          .find(file +
                ", line 3: expected one of the 27 points, counted from 0, in column \"b\", not 27"),
      std::string::npos);
  EXPECT_NE(refusal("0,1,1\n1,2,0\n", "a,b,stiffness")
                .find(file + ", line 3: expected a stiffness that is not 0"),
            std::string::npos);
  EXPECT_NE(refusal("0,1,-1\n1,2,-1\n", "a,b,stiffness")
                .find(file + ": expected stiffnesses that are positive and finite in the sum"),
            std::string::npos);
  EXPECT_NE(refusal("0,1,1\n", "a,b,stifness")
                .find(file + ", line 1: expected the name \"stiffness\" for column \"stifness\""),
            std::string::npos);
  EXPECT_NE(refusal("0,x\n").find("line 2: expected a number in column \"b\", not \"x\""),
            std::string::npos);
  EXPECT_NE(refusal("").find("has no spring"), std::string::npos);
}

TEST(Points, RefusesPointsThatCannotBeParticles) {
  const ListFiles files(3, 3, 3);
  const auto refusal = [&](const std::string& points) {
    std::ofstream(files.points) << points;
    std::ofstream(files.springs) << "a,b\n0,1\n1,2\n";
    try {
      plan_of(listed_scene(files.lattice(), {{"membrane", "none"}}));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string file = "file " + files.points.string();
  EXPECT_EQ(refusal("x,y,z,volume\n0,0,0,1\n0,0,1,1\n0,1,0,1\n"), "");
  EXPECT_NE(
      refusal("x,y,z\n0,0,0\n# between\n0,0,1\n-0,0,0\n")
          .find(file + ", line 5: expected a point at a place of its own, not at that of line 2"),
      std::string::npos);
  for (const char* volume : {"0", "-1"})
    EXPECT_NE(refusal("x,y,z,volume\n0,0,0,1\n0,0,1," + std::string(volume) + "\n0,1,0,1\n")
                  .find(file + ", line 3: expected a volume above 0, not " + volume),
              std::string::npos);
  EXPECT_NE(refusal("x,y,z,volume\n0,0,0,1\n0,0,1,1e200\n0,1,0,1\n")
                .find(file + ", line 3: expected a volume in reach of numbers"),
            std::string::npos);
  EXPECT_NE(refusal("x,y,z,volum\n0,0,0,1\n0,0,1,1\n0,1,0,1\n")
                .find(file + ", line 1: expected the name \"volume\" for column \"volum\""),
            std::string::npos);
  EXPECT_NE(refusal("x,y,z\n0,0,0\n0,0,1\n0,1e200,0\n")
                .find(file + ", line 4: expected coordinates up to 1e+50 m, not 1e+197 m"),
            std::string::npos);
}

/// Returns how a lattice of five points at the corners of a cube of this edge, m, that joins the
/// nearest is refused; "" if it is not.
std::string refusal_of_nearest(double edge, const Keys& more = {}) {
  const ListFiles files({{0, 0, 0}, {edge, 0, 0}, {0, edge, 0}, {0, 0, edge}, {edge, edge, edge}},
                        {});
  try {
    plan_of(SceneBuilder{}
                .stages(stage("lattices.points",
                              Keys{{"points", files.points.string()}, {"coordination", 3}} + more))
                .material("materials.elastic",
                          {{"density", 2500}, {"young", 1e10}, {"membrane", "none"}})
                .solver("solvers.explicit", {{"end_time", 1e-6 * edge}})
                .text());
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Points, TheNearestAreSoughtAtEveryScaleOrRefused) {
  for (const double edge : {1e-3, 1e-40, 1e10}) EXPECT_EQ(refusal_of_nearest(edge), "") << edge;
  for (const double edge : {1e-110, 1e-300})
    EXPECT_NE(refusal_of_nearest(edge).find("apart or more"), std::string::npos) << edge;
  for (const double spacing : {5e-324, 1e-300})
    EXPECT_NE(refusal_of_nearest(1, {{"spacing", spacing}}).find("expected spacing between"),
              std::string::npos)
        << spacing;
}

}  // namespace random_lattice_test
