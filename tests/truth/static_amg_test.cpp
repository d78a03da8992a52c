// Algebraic multigrid against the factorisations of solvers.static. Left out where the plugin is not built.
#include <run/stage_calls.hpp>

#include <support/lists.hpp>
#include <support/program.hpp>

#include <gtest/gtest.h>

namespace {
using namespace hyperlattice;
using namespace hyperlattice::test;

class StaticAmg : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(HYPERLATTICE_BUILD "/lib/hyperlattice/solvers.static_amg.so")) GTEST_SKIP() << "no hypre here";
  }
};
class StaticAmgMembrane : public StaticAmg, public testing::WithParamInterface<MembraneCase> {};
const MembraneCase cases[] = {
    {"none", R"("membrane": "none")"}, {"I", R"("membrane": "I", "poisson": 0.2)"}, {"clamped", R"("membrane": "III", "lambda": 1)"}};
INSTANTIATE_TEST_SUITE_P(Membranes, StaticAmgMembrane, testing::ValuesIn(cases), [](const auto& info) { return std::string(info.param.name); });

std::string solver(const std::string& type, const std::string& more) { return R"({ "type": "solvers.)" + type + R"(", )" + more + " }"; }

/// A random block of n^3 mm, pulled.
std::string pulled(int n, const std::string& solver, const std::string& material = R"("membrane": "I", "poisson": 0.2)", const char* way = "1e-6") {
  return listed_scene(random_lattice(n, n, n), material,
                      R"({ "type": "loads.fixed", "on": "z_min" },
    { "type": "loads.displacement", "on": "z_max", "value": [0, 0, )" +
                          std::string(way) + R"(], "rise": 1e-9 },)" + solver);
}

struct Found {
  std::vector<double> u;
  RestReport report;
};
Found at_rest(const std::string& scene, int threads = 1) {
  const auto plan = plan_of(scene, threads);
  Simulation simulation(*plan->model, threads);
  const RestReport report = bring_to_rest(*plan, simulation);
  return {displacements(simulation), report};
}

std::string complaint_of(const std::string& scene) {
  try {
    at_rest(scene);
  } catch (const RunError& error) {
    return error.what();
  }
  return "it came to rest";
}

TEST_P(StaticAmgMembrane, AgreesWithTheWholeFactorisation) {
  const Found whole = at_rest(pulled(8, solver("static", R"("tolerance": 1e-9, "factorisation": "whole")"), GetParam().material));
  const Found amg = at_rest(pulled(8, solver("static_amg", R"("tolerance": 1e-9)"), GetParam().material));
  EXPECT_LT(distance(whole.u, amg.u), 1e-7 * largest(whole.u));
  EXPECT_LE(amg.report.residual, 1e-9);
}

// The cost of an iteration is in proportion to the body's size, so what counts is how their number grows.
TEST_F(StaticAmg, IterationsGrowLessThanThoseOfAnIncompleteFactorisation) {
  const auto iterations = [](int n, const std::string& solver) { return static_cast<double>(at_rest(pulled(n, solver)).report.iterations); };
  const std::string amg = solver("static_amg", R"("tolerance": 1e-6)"),
                    incomplete = solver("static", R"("tolerance": 1e-6, "factorisation": "incomplete")");
  for (const int n : {14, 22}) {
    const double few = iterations(n, amg), many = iterations(n, incomplete);
    std::printf("%d^3: %g iterations, %g with an incomplete factorisation\n", n, few, many);
    EXPECT_LE(few, many / 3) << n;
  }
}

TEST_P(StaticAmgMembrane, HasTheSameBitsForAnyNumberOfThreads) {
  const std::string scene = pulled(9, solver("static_amg", R"("tolerance": 1e-6)"), GetParam().material);
  EXPECT_EQ(at_rest(scene, 1).u, at_rest(scene, 3).u);
}

// A bar bent by a third of its length, against the factorisation.
TEST_F(StaticAmg, LargeRotations) {
  const auto bent = [](const std::string& solver) {
    return listed_scene(random_lattice(3, 3, 16, R"("coordination": 13)"), R"("membrane": "I", "poisson": 0.2)",
                        R"({ "type": "loads.fixed", "on": "z_min" },
    { "type": "loads.displacement", "on": "z_max", "axes": "x", "value": [5e-3, 0, 0], "rise": 1e-9 },)" +
                            solver);
  };
  const Found whole = at_rest(bent(solver("static", R"("tolerance": 1e-9, "factorisation": "whole")")));
  const Found amg = at_rest(bent(solver("static_amg", R"("tolerance": 1e-9)")));
  EXPECT_GT(largest(whole.u), 4.9e-3);
  EXPECT_LT(distance(whole.u, amg.u), 1e-6 * largest(whole.u));
}

TEST_F(StaticAmg, ABodyThatNothingHoldsIsToldHowItMoves) {
  const ListFiles files(4, 4, 4);
  const auto fallen = [&](const std::string& type) {
    return complaint_of(listed_scene(files.lattice(), R"("membrane": "none")",
                                     R"({ "type": "loads.gravity", "acceleration": [0, -9.81, 0] }, { "type": "solvers.)" + type + R"(" })"));
  };
  EXPECT_NE(fallen("static_amg").find("the whole body can move as a rigid one: it slides along (0, -1, 0)"), std::string::npos)
      << fallen("static_amg");
  const auto sentence = [&](const std::string& type) { return fallen(type).substr(fallen(type).find(" failed: ")); };
  EXPECT_EQ(sentence("static_amg"), sentence("static"));
}

TEST_F(StaticAmg, RefusesStructuredLattices) {
  try {
    plan_of(block(3, 3, 3, R"("poisson": 0.25)", R"({ "type": "solvers.static_amg" })"));
    FAIL() << "it was planned";
  } catch (const InputError& error) {
    ASSERT_EQ(error.faults().size(), 1u);
    EXPECT_NE(error.faults().front().expected.find("solvers.static"), std::string::npos) << error.faults().front().expected;
  }
}

}  // namespace
