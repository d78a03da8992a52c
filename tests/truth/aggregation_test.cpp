// Multigrid by aggregation on listed lattices, compared with factorisations.
#include <engine/stage_calls.hpp>

#include <support/lists.hpp>

#include <gtest/gtest.h>

namespace aggregation_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

class Aggregation : public testing::TestWithParam<MembraneCase> {};
const MembraneCase cases[] = {{"none", R"("membrane": "none")"},
                              {"I", R"("membrane": "I", "poisson": 0.2)"},
                              {"clamped", R"("membrane": "III", "lambda": 1)"}};
INSTANTIATE_TEST_SUITE_P(Membranes, Aggregation, testing::ValuesIn(cases),
                         [](const auto& info) { return std::string(info.param.name); });

Stages solver(const char* preconditioner, double tolerance) {
  return stage("solvers.static", {{"preconditioner", preconditioner}, {"tolerance", tolerance}});
}

/// A random block of n^3 mm that a displacement of `way` (m) pulls along z.
std::string pulled(int n, const Stages& solver,
                   const Keys& material = {{"membrane", "I"}, {"poisson", 0.2}},
                   double way = 1e-6) {
  return listed_scene(random_lattice(n, n, n), material,
                      stage("loads.fixed", {{"on", "z_min"}}) +
                          stage("loads.displacement",
                                {{"on", "z_max"}, {"value", Vec3{0, 0, way}}, {"rise", 1e-9}}) +
                          solver);
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

TEST_P(Aggregation, AgreesWithTheWholeFactorisation) {
  const Found whole = at_rest(pulled(8, solver("whole", 1e-9), GetParam().material));
  const Found levels = at_rest(pulled(8, solver("multigrid", 1e-9), GetParam().material));
  EXPECT_LT(distance(whole.u, levels.u), 1e-7 * largest(whole.u));
  EXPECT_LE(levels.report.residual, 1e-9);
}

// The cost of an iteration is in proportion to the size of the body. The number of iterations must
// therefore grow slowly with the size.
TEST(AggregationOf, IterationsGrowLessThanThoseOfAnIncompleteFactorisation) {
  const auto iterations = [](int n, const Stages& solver) {
    return static_cast<double>(at_rest(pulled(n, solver)).report.iterations);
  };
  const Stages levels = solver("multigrid", 1e-6), incomplete = solver("incomplete", 1e-6);
  for (const int n : {14, 22}) {
    const double few = iterations(n, levels), many = iterations(n, incomplete);
    std::printf("%d^3: %g iterations, %g with an incomplete factorisation\n", n, few, many);
    EXPECT_LE(few, many / 2.5) << n;
  }
}

TEST_P(Aggregation, HasTheSameBitsForAnyNumberOfThreads) {
  const std::string scene = pulled(9, solver("multigrid", 1e-6), GetParam().material);
  EXPECT_EQ(at_rest(scene, 1).u, at_rest(scene, 3).u);
}

// A bar whose end moves by a third of its length, compared with the factorisation.
TEST(AggregationOf, LargeRotations) {
  const auto bent = [](const Stages& solver) {
    return listed_scene(
        random_lattice(3, 3, 16, {{"coordination", 13}}), {{"membrane", "I"}, {"poisson", 0.2}},
        stage("loads.fixed", {{"on", "z_min"}}) +
            stage("loads.displacement",
                  {{"on", "z_max"}, {"axes", "x"}, {"value", {5e-3, 0, 0}}, {"rise", 1e-9}}) +
            solver);
  };
  const Found whole = at_rest(bent(solver("whole", 1e-9)));
  const Found levels = at_rest(bent(solver("multigrid", 1e-9)));
  EXPECT_GT(largest(whole.u), 4.9e-3);
  EXPECT_LT(distance(whole.u, levels.u), 1e-6 * largest(whole.u));
}

TEST(AggregationOf, ABodyThatNothingHoldsIsToldHowItMoves) {
  const ListFiles files(4, 4, 4);
  for (const char* preconditioner : {"whole", "multigrid"}) {
    const std::string complaint = complaint_of(listed_scene(
        files.lattice(), {{"membrane", "none"}},
        stage("loads.gravity", {{"acceleration", {0, -9.81, 0}}}) + solver(preconditioner, 1e-6)));
    EXPECT_NE(complaint.find("the whole body can move as a rigid one: it slides along (0, -1, 0)"),
              std::string::npos)
        << complaint;
  }
}

}  // namespace aggregation_test
