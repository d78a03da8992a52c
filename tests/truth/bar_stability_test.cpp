// A bar of cohesive material that is pulled slowly snaps if and only if it is longer than
// 2 E G / sigma_t^2: then it gives back more energy, as its force falls, than its crack takes.
#include <support/cohesive_bar.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace bar_stability_test {
using namespace hyperlattice;
using namespace hyperlattice::test;
using namespace hyperlattice::test::cohesive_bar;

struct Pull {
  double ratio = 0;    ///< of the bar's length to that of the threshold
  double growth = 0;   ///< of the bar while its force falls from 0.8 to 0.2 of the peak, over w_c
  double kinetic = 0;  ///< largest kinetic energy after the peak, over G A
  double work = 0;     ///< of the rims until the force has fallen to 0.05 of the peak, over G A
};

/// Pulls a bar of 2 `half` cells.
Pull pull(int half, double length) {
  Bar bar(half, 0.25, length, "double");
  const Model& model = *bar.plan->model;
  const double toughness = model.cohesive[0].corrected, last = 2 * toughness / strength,
               area = spacing * spacing, step = 0.85 * model.step_limit.time_step;
  Pull found;
  double compliance = 0, peak = 0, from = 0, to = 0;
  for (int n = 0; bar.simulation->time() < 2 * Bar::time(mm(2 * half)); ++n) {
    bar.simulation->step(step);
    if (n % 10 != 0) continue;
    const double stress = bar.stress(), growth = bar.growth();
    if (peak < 0.8 * strength && stress > 0.4 * strength) compliance = growth / stress;
    peak = std::max(peak, stress);
    if (peak < 0.9 * strength) continue;
    found.kinetic = std::max(found.kinetic, bar.simulation->kinetic() / (toughness * area));
    if (stress > 0.8 * peak) from = growth;
    if (stress > 0.2 * peak) to = growth;
    if (stress < 0.05 * peak) break;
  }
  found.ratio = strength * compliance / last;
  found.growth = (to - from) / last;
  for (const double work : bar.simulation->injected_by_load())
    found.work += work / (toughness * area);
  std::printf("L %.3f of the threshold: growth %.4f w_c, kinetic %.2e, work %.4f; peak %.4f\n",
              found.ratio, found.growth, found.kinetic, found.work, peak / strength);
  return found;
}

TEST(BarStability, ABarSnapsIfItIsLongerThanTheThreshold) {
  const Pull brief = pull(6, 3e-3), extended = pull(13, 3e-3);
  EXPECT_LT(brief.ratio, 0.8);
  EXPECT_GT(extended.ratio, 1.3);
  // While w grows by 0.6 w_c, what is elastic shortens by 0.6 w_c times the ratio. The band of the
  // short bar reaches nearly to its ends, so that this is only about so.
  EXPECT_GT(brief.growth, 0.3 * (1 - brief.ratio));
  EXPECT_LT(brief.growth, 0.8 * (1 - brief.ratio));
  EXPECT_LT(extended.growth, 0.02);
  EXPECT_LT(brief.kinetic, 5e-3);
  EXPECT_GT(extended.kinetic, 0.1);
  // The rims have done the work of the crack, or have stored sigma_t^2 L A / (2 E) at the peak. The
  // damping takes some more.
  EXPECT_NEAR(brief.work, 1, 0.05);
  EXPECT_NEAR(extended.work, extended.ratio, 0.08 * extended.ratio);
}

}  // namespace bar_stability_test
