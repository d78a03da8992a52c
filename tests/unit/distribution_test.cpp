// What the plan tells of the ranks of a run: where the whole state is, and the memory of each rank.
#include "support/program.hpp"

#include <plan/distribution.hpp>
#include <plan/plan.hpp>

#include <gtest/gtest.h>

namespace distribution_test {
using namespace hyperlattice;
using nlohmann::json;

json cube() {
  return {{"format", "hyperlattice/1"},
          {"pipeline",
           {{{"type", "lattices.cubic"},
             {"spacing", 1e-3},
             {"shape", {{"box", {{"low", {0, 0, 0}}, {"high", {0.04, 0.04, 0.04}}}}}}},
            {{"type", "materials.elastic"},
             {"young", 10e9},
             {"poisson", 0.25},
             {"density", 2500},
             {"membrane", "none"}},
            {{"type", "loads.force"}, {"on", "z_max"}, {"total", {0, 0, 100}}},
            {{"type", "solvers.explicit"}, {"end_time", 1e-5}}}}};
}

Distribution shared(const json& scene, int ranks) {
  const test::Folder folder("distribution");
  setenv("HYPERLATTICE_PLUGIN_PATH", HYPERLATTICE_BUILD "/lib/hyperlattice", 1);
  static Host host;
  const auto plan = make_plan(read_scene(test::write_scene(folder, scene), {}, host), 1, ranks);
  return distribution_of(*plan, {});
}

TEST(Distribution, ARankHasItsPartOfTheStateAlone) {
  const Distribution one = shared(cube(), 1), four = shared(cube(), 4);
  const double state = one.shares.front().state_bytes;
  EXPECT_EQ(one.whole_in_ranks + four.whole_in_ranks + four.first_whole, "");
  ASSERT_EQ(four.shares.size(), 4U);
  constexpr double engine = 10e6;
  for (const RankShare& share : four.shares) {
    EXPECT_NEAR(share.state_bytes, state / 4, 0.1 * state);  // and the planes at its cuts
    EXPECT_LT(share.memory_bytes - engine, one.shares.front().memory_bytes - 0.6 * state);
  }
}

TEST(Distribution, AnOutputThatNeedsTheWholeStateBringsItToTheFirstRank) {
  json scene = cube();
  json& pipeline = scene["pipeline"];
  pipeline.push_back({{"type", "probes.point"}, {"position", {0, 0, 0}}});
  EXPECT_EQ(shared(scene, 4).first_whole, "");
  pipeline.back()["field"] = "von_mises";
  EXPECT_EQ(shared(scene, 4).first_whole, "point asks for more than the motion of particles");
  pipeline.back() = {{"type", "probes.reaction"}, {"on", "z_min"}};
  EXPECT_EQ(shared(scene, 4).first_whole, "reaction asks for more than the motion of particles");
}

TEST(Distribution, ASolverOfEquationsHoldsTheWholeStateInEachRank) {
  json scene = cube();
  scene["pipeline"].push_back(
      {{"type", "solvers.implicit"}, {"end_time", 2e-5}, {"time_step", 1e-6}});
  const Distribution found = shared(scene, 4);
  EXPECT_EQ(found.whole_in_ranks, "implicit works on the whole body");
  EXPECT_EQ(found.whole, "");
}

}  // namespace distribution_test
