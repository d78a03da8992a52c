// States of rest that an opening controls. A chain whose weak springs break has a closed form on
// both sides of its snap-back. damage_at_rest_test.cpp has a bar that softens.
#include <support/motion.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace opening_control_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr int springs = 8;
constexpr double young = 1e9, spacing = 1e-3, limit = 1e-3, pull = 1.6e-2 * springs * spacing;
// A spring of the lattice without a membrane has k = 2/5 E l (docs/theory/calibration.md).
constexpr double stiffness = 0.4 * young * spacing;

Json slice(double low, double high) { return box({low, -1, -1}, {high, 1, 1}); }

/// A chain of particles along x whose end is pulled. The springs of its third particle break at
/// the strain `limit`, all others far beyond.
std::string chain(const Keys& solver) {
  const auto elastic = [](double breaks, const Keys& more = {}) {
    return stage("materials.elastic",
                 Keys{{"young", young},
                      {"density", 1000},
                      {"poisson", 0.25},
                      {"failure", {{"type", "failures.strain"}, {"limit", breaks}}}} +
                     more);
  };
  return SceneBuilder{}
      .lattice("lattices.cubic", spacing, box_mm(springs + 1, 1, 1))
      .stages(elastic(1))
      .stages(elastic(limit, {{"name", "weak"}, {"region", slice(3.4e-3, 3.6e-3)}}))
      .stage("loads.fixed", {{"on", "all"}, {"axes", "yz"}})
      .stage("loads.fixed", {{"on", "x_min"}, {"axes", "x"}})
      .stage("loads.displacement",
             {{"on", "x_max"}, {"axes", "x"}, {"value", {pull, 0, 0}}, {"rise", 1}})
      .solver("solvers.static", Keys{{"end_time", 1}, {"tolerance", 1e-10}} + solver)
      .text();
}

TEST(OpeningControl, AChainSnapsBackAsItsClosedFormSays) {
  // The opening is that of the two weak springs. Before they break, at c = 2 l limit, the end moves
  // by springs / 2 times the opening. Then the chain is in two or three pieces without force: the
  // end moves by the opening, so that it falls back to c at once.
  Motion run(chain({{"opening_from", slice(2.4e-3, 2.6e-3)},
                    {"opening_to", slice(4.4e-3, 4.6e-3)},
                    {"opening_direction", {1, 0, 0}},
                    {"opening_step", 3e-7}}));
  constexpr double breaks = 2 * spacing * limit;
  double before = 0, largest = 0;
  int whole = 0, torn = 0;
  run.go([&] {
    const std::vector<double> u = displacements(run.simulation);
    const double opening = u[3 * 4] - u[3 * 2], end = run.end(),
                 force = -run.simulation.force_on_load().back().x;
    const double ratio = run.simulation.broken() == 0 ? springs / 2.0 : 1;
    (ratio > 1 ? whole : torn) += 1;
    EXPECT_NEAR(end, ratio * opening, 1e-8 * breaks) << opening;
    EXPECT_NEAR(force, ratio > 1 ? stiffness * opening / 2 : 0, 1e-7 * stiffness * breaks);
    EXPECT_GE(opening, before * (1 - 1e-3));
    before = opening;
    largest = std::max(largest, std::abs(run.simulation.balance().relative_error()));
  });
  std::printf("%d states of the whole chain, %d of the torn one, balance %.1e\n", whole, torn,
              largest);
  EXPECT_GE(whole, 6);
  EXPECT_GE(torn, 20);
  const std::vector<Breakage>& broken = run.simulation.breakages();
  ASSERT_EQ(broken.size(), 2U);
  EXPECT_NEAR(broken.front().time * pull, springs / 2.0 * breaks, 1.1e-3 * springs / 2.0 * breaks);
  EXPECT_NEAR(run.end(), pull, 1e-12);
  EXPECT_LT(largest, 1e-9);
}

TEST(OpeningControl, EndsAtItsEnd) {
  constexpr double end = 1.25e-6;
  Motion run(chain({{"opening_from", "x_min"},
                    {"opening_to", slice(2.4e-3, 2.6e-3)},
                    {"opening_step", 5e-7},
                    {"opening_end", end}}));
  std::vector<double> openings;
  run.go([&] { openings.push_back(displacements(run.simulation)[3 * 2]); });
  ASSERT_EQ(openings.size(), 4U);
  for (std::size_t n = 0; n < openings.size(); ++n)
    EXPECT_NEAR(openings[n], std::min(end, 5e-7 * static_cast<double>(n)), 1e-3 * 5e-7);
}

/// A step far longer than any opening is cut until the first failure is met. It must not be taken
/// for an error that is allowed.
TEST(OpeningControl, AStepOfACentimetreIsCut) {
  Motion run(chain({{"opening_from", "x_min"},
                    {"opening_to", slice(4.4e-3, 4.6e-3)},
                    {"opening_step", 0.01},
                    {"most_cutbacks", 20}}));
  run.go([] {});
  const std::vector<Breakage>& broken = run.simulation.breakages();
  ASSERT_EQ(broken.size(), 2U);
  EXPECT_NEAR(broken.front().elongation, spacing * limit, 1.1e-3 * spacing * limit);
  EXPECT_NEAR(run.end(), pull, 1e-12);
}

}  // namespace opening_control_test
