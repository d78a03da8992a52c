// The energy balance closes for every way in which energy enters and leaves: to round-off in linear
// motions, otherwise with an error in proportion to the square of the step.
#include <support/energy_balance.hpp>
#include <support/scenes.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace balance_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

struct Flow {
  const char* name;
  const char* loads;
  double damping;
  double tolerance;  ///< bound of the largest relative error at any step; 0.4 critical steps
};
const Flow flows[] = {
    {"falling_freely", R"({ "type": "loads.gravity", "acceleration": [0, 0, -9.81] })", 0, 1e-12},
    {"hanging",
     R"({ "type": "loads.gravity", "acceleration": [0, 0, -9.81] }, { "type": "loads.fixed", "on": "z_max", "axes": "xyz" })",
     0, 1e-10},
    {"pulled_at_once",
     R"({ "type": "loads.force", "on": "z_max", "total": [0, 0, 20] }, { "type": "loads.fixed", "on": "z_min", "axes": "xyz" })",
     0, 2e-4},
    {"pulled_and_damped",
     R"({ "type": "loads.force", "on": "z_max", "total": [0, 0, 20] }, { "type": "loads.fixed", "on": "z_min", "axes": "xyz" })",
     0.5, 1e-6},
    {"driven",
     R"({ "type": "loads.velocity", "on": "z_max", "axes": "z", "value": [0, 0, 1] }, { "type": "loads.fixed", "on": "z_min", "axes": "xyz" })",
     0, 2e-4},
    {"displaced",
     R"({ "type": "loads.displacement", "on": "z_max", "axes": "z", "value": [0, 0, 1e-6], "rise": "2 us" }, { "type": "loads.fixed", "on": "z_min", "axes": "xyz" })",
     0, 1e-5},
};

class Balanced : public testing::TestWithParam<Flow> {};
INSTANTIATE_TEST_SUITE_P(Flows, Balanced, testing::ValuesIn(flows),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_P(Balanced, AtEveryStep) {
  for (const char* membrane : {R"("poisson": 0.25)", R"("membrane": "I-m", "poisson": 0.1)"}) {
    const auto plan = plan_of(block(6, 5, 8, membrane, GetParam().loads));
    const auto error = [&](double fraction) {
      return worst_balance(*plan->model, fraction, GetParam().damping).largest_error;
    };
    const double coarse = error(0.4), fine = error(0.1);
    std::printf("%s: largest relative error %.1e at 0.4 of the critical step, %.1e at 0.1\n",
                GetParam().name, coarse, fine);
    EXPECT_LT(coarse, GetParam().tolerance) << membrane;
    EXPECT_LT(fine, std::max(1e-13, coarse / 10))
        << membrane << ": a quarter of the step, a sixteenth of the error";
  }
}

TEST(Breaking, TakesTheEnergyOfTheSpringsThatAreGone) {
  const auto plan = plan_of(block(
      6, 6, 12,
      R"("membrane": "I-m", "poisson": 0.2, "failure": { "type": "failures.elongation", "limit": 1e-6 })",
      R"({ "type": "loads.velocity", "on": "z_max", "axes": "z", "value": [0, 0, 4] },
                                     { "type": "loads.fixed", "on": "z_min", "axes": "xyz" })"));
  const auto run = [&](double fraction) {
    Simulation simulation(*plan->model, 2);
    const int steps =
        static_cast<int>(std::ceil(8e-6 / (fraction * plan->model->step_limit.time_step)));
    double worst = 0;
    for (int n = 0; n < steps; ++n) {
      simulation.step(8e-6 / steps);
      worst = std::max(worst, std::abs(simulation.balance().relative_error()));
    }
    EXPECT_GT(simulation.breakages().size(), 30u);
    EXPECT_GT(simulation.balance().dissipated_failure, 0.1 * simulation.balance().injected);
    return worst;
  };
  const double coarse = run(0.5), fine = run(0.05);
  std::printf("breaking: largest relative error %.1e at 0.5 of the critical step, %.1e at 0.05\n",
              coarse, fine);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_LT(fine, coarse / 30);
}

}  // namespace balance_test
