// Failure criteria and laws that a scene writes as expressions, against built-in components and
// closed forms.
#include <support/lists.hpp>
#include <support/models.hpp>

#include <base/errors.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace written_laws_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr double l = 1e-3, k = 0.4 * 1e10 * l;  // as in block(), nu = 1/4

Keys failing(const std::string& criterion, const Keys& keys) {
  return {{"poisson", 0.25}, {"failure", (Keys{{"type", "failures." + criterion}} + keys).json()}};
}
Keys written(const std::string& when, const std::vector<std::string>& constants = {}) {
  return failing("expression", {{"when", when}, {"constants", constants}});
}

/// What a body is after some steps of violent motion.
struct Outcome {
  std::uint64_t hash = 0;
  std::size_t broken = 0;
  bool operator==(const Outcome&) const = default;
};
Outcome shaken(const std::string& scene, int threads = 1) {
  const auto plan = plan_of(scene, threads);
  Simulation simulation(*plan->model, threads);
  simulation.set_displacements(noise(3 * plan->model->body.particles, 2e-6), {});
  for (int n = 0; n < 40; ++n) simulation.step(0.5 * plan->model->step_limit.time_step);
  return {simulation.hash(), simulation.breakages().size()};
}
Outcome shaken_block(const Keys& material, int threads = 1) {
  return shaken(block(6, 5, 8, material), threads);
}

TEST(WrittenCriteria, BreakTheSameSpringsAsBuiltInOnes) {
  const struct {
    const char* criterion;
    Keys keys;
    std::string when;
    std::vector<std::string> constants = {};
    bool same_bits = true;  // the alarms are equal
  } cases[] = {
      {"strain", {{"limit", 2e-3}}, "strain > 2e-3"},
      {"strain", {{"limit", 2e-3}}, "elongation / rest_length > limit", {"limit = 0.2 %"}},
      {"elongation", {{"limit", 2e-6}}, "elongation > 2 um"},
      {"elongation", {{"limit", 2e-6}}, "elongation > limit", {"half = 1 um", "limit = 2 * half"}},
      {"force", {{"limit", 8}}, "force > 8 N"},
      {"energy",
       {{"limit", 8e-6}},
       "strain > 0 && 0.5 * stiffness * elongation * elongation > 8e-6 J",
       {},
       false},
      {"rate",
       {{"limit", 1e-3}, {"reference", 1e3}},
       "elongation > 1e-3 * rest_length * (1 + max(strain_rate, 0) / (1e3 1/s))"},
  };
  for (const auto& one : cases) {
    const Outcome built_in = shaken_block(failing(one.criterion, one.keys));
    EXPECT_GT(built_in.broken, 20u) << one.when;
    const Outcome own = shaken_block(written(one.when, one.constants));
    EXPECT_EQ(own.broken, built_in.broken) << one.when;
    if (one.same_bits) {
      EXPECT_EQ(own.hash, built_in.hash) << one.when;
    }
    EXPECT_EQ(shaken_block(written(one.when, one.constants), 3), own) << one.when;
  }
}

/// Counts the springs that break in one short step, and those for which `by_hand` holds of their
/// strain.
std::pair<std::size_t, std::size_t> counts(const std::string& when, bool (*by_hand)(double)) {
  const auto plan = plan_of(block(6, 5, 8, written(when)));
  const Model& model = *plan->model;
  const std::vector<double> u = noise(3 * model.body.particles, 2e-6);
  const auto place = [&](Particle p) {
    return model.body.position(p) + Vec3{u[3 * p], u[3 * p + 1], u[3 * p + 2]};
  };
  std::size_t expected = 0;
  model.body.for_springs([&](Particle a, Particle b, std::uint32_t) {
    const double rest = norm(model.body.position(b) - model.body.position(a));
    expected += by_hand(norm(place(b) - place(a)) / rest - 1) ? 1 : 0;
  });
  Simulation simulation(model, 1);
  simulation.set_displacements(u, {});
  simulation.step(1e-6 * model.step_limit.time_step);
  return {simulation.breakages().size(), expected};
}

TEST(WrittenCriteria, FindAllSpringsWhereverTheyMayHold) {
  const auto agree = [](const std::string& when, bool (*by_hand)(double)) {
    const auto [broken, expected] = counts(when, by_hand);
    EXPECT_EQ(broken, expected) << when;
    EXPECT_GT(expected, 20u) << when;
  };
  agree("strain > 1e-3", [](double e) { return e > 1e-3; });
  agree("strain < -1e-3", [](double e) { return e < -1e-3; });
  agree("abs(strain) > 1e-3", [](double e) { return std::abs(e) > 1e-3; });
  agree("strain > 0 && exp(1e3 * strain) > 2",
        [](double e) { return e > 0 && std::exp(1e3 * e) > 2; });
  EXPECT_EQ(counts("time > 1 s", [](double) { return false; }).first, 0u);
}

TEST(WrittenCriteria, WorkOnLists) {
  const ListFiles files(5, 4, 6);
  const auto scene = [&](const Keys& material) {
    return listed_scene(files.lattice(), Keys{{"membrane", "none"}} + material);
  };
  const Outcome built_in = shaken(scene(failing("strain", {{"limit", 2e-3}})));
  EXPECT_GT(built_in.broken, 20u);
  EXPECT_EQ(shaken(scene(written("strain > 2e-3"))), built_in);
  EXPECT_EQ(shaken(scene(written("strain > 1e-3 * (1 + max(strain_rate, 0) / (1e3 1/s))")), 3),
            shaken(scene(failing("rate", {{"limit", 1e-3}, {"reference", 1e3}}))));
}

TEST(WrittenCriteria, FaultsSayWhatIsWrong) {
  const auto message = [](const Keys& material) -> std::string {
    try {
      plan_of(block(2, 2, 2, material));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto says = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_PRED2(
      says, message(written("strain > 1 mm")),
      "/pipeline/1/failure/when: \"strain > 1 mm\": expected a condition of a spring, such "
      "as strain > 1e-3; \">\" stands between a number and a length");
  EXPECT_PRED2(says, message(written("strian > 1")), "did you mean \"strain\"?");
  EXPECT_PRED2(says, message(written("strain * 2")), "and no number");
  EXPECT_PRED2(says, message(written("strain > c", {"c = elongation"})), "depends on the spring");
  EXPECT_PRED2(says, message(written("strain > c", {"strain = 2"})), "the name is taken");
  EXPECT_PRED2(says, message(written("strain > c", {"c"})),
               "/pipeline/1/failure/constants: [\"c\"]: expected \"name = quantity\"");
}

std::string solid(const std::string& law, const Keys& keys, int nx, int ny, int nz,
                  const std::string& membrane = "none") {
  return SceneBuilder{}
      .lattice("lattices.cubic", l, box_mm(nx, ny, nz))
      .material("materials." + law, Keys{{"young", 1e10},
                                         {"density", 2500},
                                         {"poisson", membrane == "none" ? 0.25 : 0.1},
                                         {"membrane", membrane}} +
                                        keys)
      .solver("solvers.explicit", {{"end_time", 1e-6}})
      .text();
}

/// Displacements after some steps of a random motion.
std::vector<double> moved(const std::string& scene, double amplitude) {
  const auto plan = plan_of(scene);
  Simulation simulation(*plan->model, 1);
  simulation.set_displacements(noise(3 * plan->model->body.particles, amplitude), {});
  for (int n = 0; n < 30; ++n) simulation.step(0.3 * plan->model->step_limit.time_step);
  return displacements(simulation);
}

TEST(WrittenLaws, AgreeWithBuiltInOnes) {
  constexpr double amplitude = 1e-5;
  for (const char* membrane : {"none", "I-m"}) {
    const auto elastic = moved(solid("elastic", {}, 4, 3, 5, membrane), amplitude);
    EXPECT_LT(distance(moved(solid("expression", {{"force", "stiffness * elongation"}}, 4, 3, 5,
                                   membrane),
                             amplitude),
                       elastic),
              1e-12 * largest(elastic));
    const auto viscous = moved(solid("viscous", {{"time", 2e-8}}, 4, 3, 5, membrane), amplitude);
    const Keys damper{{"force", "stiffness * (elongation + tau * rate)"},
                      {"constants", {"tau = 20 ns"}}};
    EXPECT_LT(distance(moved(solid("expression", damper, 4, 3, 5, membrane), amplitude), viscous),
              1e-12 * largest(viscous));
    EXPECT_GT(distance(viscous, elastic), 0.01 * largest(elastic));
  }
}

/// Two particles on a spring whose force is k u (1 + (u / a)^2): half of the energy of their motion
/// goes into the spring, k A^2 / 2 + k A^4 / (4 a^2) = m v^2 / 4 for the relative velocity v.
TEST(WrittenLaws, AStiffeningSpringSwingsAsFarAsItsEnergySays) {
  for (const char* energy :
       {"", "stiffness * elongation^2 / 2 * (1 + (elongation / wide)^2 / 2)"}) {
    Keys keys{{"force", "stiffness * elongation * (1 + (elongation / wide)^2)"},
              {"constants", {"wide = 20 um"}}};
    if (*energy != '\0') keys = keys + Keys{{"energy", energy}};
    const auto plan = plan_of(solid("expression", keys, 2, 1, 1));
    const Model& model = *plan->model;
    Simulation simulation(model, 1);
    constexpr double start = 5e-5, wide = 2e-5;
    std::vector<double> u(6, 0.0);
    u[3] = start;
    simulation.set_displacements(u, {});
    const double step = 0.01 * model.step_limit.time_step;
    const double stored = 0.5 * k * start * start + 0.25 * k * std::pow(start, 4) / (wide * wide);
    double shortest = start, fastest = 0;
    for (int n = 0; n < 2000; ++n) {
      simulation.step(step);
      const auto now = displacements(simulation);
      shortest = std::min(shortest, now[3] - now[0]);
      fastest = std::max(fastest, simulation.balance().kinetic);
    }
    EXPECT_NEAR(shortest, -start, 1e-3 * start) << energy;
    EXPECT_NEAR(fastest, stored, 1e-3 * stored) << energy;
    EXPECT_LT(simulation.balance().relative_error(), 1e-3) << energy;
  }
}

TEST(WrittenLaws, ThoseThatAreNoSolidAreRefused) {
  const auto message = [](const Keys& keys) -> std::string {
    try {
      plan_of(solid("expression", keys, 2, 2, 2));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto says = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_PRED2(says, message({{"force", "stiffness * strain"}}), "it is a stiffness");
  EXPECT_PRED2(says, message({{"force", "stiffness * (elongation + 1 um)"}}), "zero at rest");
  EXPECT_PRED2(says, message({{"force", "2 * stiffness * elongation"}}), "and not 2.0");
  EXPECT_PRED2(says, message({{"force", "stiffness * (elongation - 1 us * rate)"}}),
               "does not fall when the spring lengthens faster");
  EXPECT_PRED2(
      says, message({{"force", "stiffness * elongation"}, {"energy", "stiffness * elongation^2"}}),
      "energy that is the integral of the force");
  EXPECT_PRED2(says, message({{"force", "stiffness * elongaton"}}), "did you mean \"elongation\"?");
}

}  // namespace written_laws_test
