// The relaxation solver never exceeds the stable step, continues at least to the last corner of the
// loads, stops at a small residual, and fails if the residual stays large.
#include "../../plugins/solvers/relaxation/relaxation.cpp"

#include <gtest/gtest.h>

#include <vector>

namespace relaxation_test {
using namespace hyperlattice;

/// A host whose residual falls to a tenth at each measurement, and whose kinetic energy has a peak
/// every twelfth step.
struct Host {
  std::uint64_t steps = 0, halts = 0, measurements = 0;
  std::vector<double> rates;
  double reduction = 0.1, residual = 1, error_over_residual = 1000;
  RestReport last;
  SolverHost host;

  Host() {
    host.self = this;
    host.take_step = [](void* self, double) noexcept {
      return ++static_cast<Host*>(self)->steps > 0;
    };
    host.show = [](void*) noexcept { return true; };
    host.stop_motion = [](void* self) noexcept { return ++static_cast<Host*>(self)->halts > 0; };
    host.measure_rest = [](void* self, RestReport* report, double* kinetic) noexcept {
      Host& h = *static_cast<Host*>(self);
      if (kinetic != nullptr)
        *kinetic = h.steps % 12 == 0 ? 0.5 : 1 + static_cast<double>(h.steps % 12);
      if (report == nullptr) return true;
      ++h.measurements;
      report->residual = h.residual *= h.reduction;
      if (h.measurements > 2) report->displacement_error = h.error_over_residual * h.residual;
      return true;
    };
    host.set_damping_rate = [](void* self, double rate) noexcept {
      static_cast<Host*>(self)->rates.push_back(rate);
    };
    host.show_rest = [](void* self, const RestReport& report) noexcept {
      static_cast<Host*>(self)->last = report;
      return true;
    };
    host.keep_numbers = [](void*, const double*, std::size_t) noexcept {};
  }
};

Relaxation::Options options() { return {}; }

TEST(Relaxation, StopsWhenTheResidualIsSmall) {
  Host host;
  Relaxation::Options o = options();
  o.tolerance = 2e-4;
  Relaxation(o).run({0, 1, {}, 10}, host.host);
  EXPECT_EQ(host.measurements, 4u);
  EXPECT_EQ(host.last.iterations, host.steps);
  EXPECT_LE(host.last.residual, o.tolerance);
  EXPECT_EQ(host.halts, 1u);  // once, at the end
}

TEST(Relaxation, StopsWhenTheErrorOfDisplacementsIsSmall) {
  Host host;
  Relaxation::Options o = options();
  o.tolerance = 1;
  o.displacement_error = 2e-3;
  Relaxation(o).run({0, 1, {}, 10}, host.host);
  EXPECT_EQ(host.measurements, 6u);  // from the third on, the errors are 1, 0.1, 0.01 and 0.001

  host = Host();
  host.host.self = &host;
  host.reduction = 1;
  o.most_steps = 100;
  EXPECT_THROW(Relaxation(o).run({0, 1, {}, 10}, host.host), std::runtime_error);
}

TEST(Relaxation, AcceleratedRestartsWhereTheKineticEnergyFalls) {
  Host host;
  Relaxation::Options o = options();
  o.method = Damping::accelerated;
  o.time_step = 0.5;
  Relaxation(o).run({0, 1, {}, 10}, host.host);
  ASSERT_EQ(host.rates.size(), host.steps);
  for (std::size_t n = 0; n < host.rates.size(); ++n)
    EXPECT_DOUBLE_EQ(host.rates[n], 6 / ((2 * static_cast<double>(n % 12) + 3) * 0.5)) << n;
}

TEST(Relaxation, ABodyThatNeverRestsIsAFailure) {
  Host host;
  host.reduction = 1;
  Relaxation::Options o = options();
  o.most_steps = 100;
  EXPECT_THROW(Relaxation(o).run({0, 1, {}, 10}, host.host), std::runtime_error);
  EXPECT_EQ(host.steps, 100u);
}

TEST(Relaxation, StepsAreStableAndTheEndIsTheLastCorner) {
  const double corners[] = {0.5, 2};
  const SolverFacts facts{1, 1e-3, corners, 10};
  const SolverPlan plan = Relaxation(options()).plan(facts);
  EXPECT_DOUBLE_EQ(plan.stable_time_step, 1e-3 / std::sqrt(1.8));
  EXPECT_DOUBLE_EQ(plan.time_step, 0.9 * plan.stable_time_step);
  EXPECT_EQ(plan.end_time, 2);
  EXPECT_TRUE(plan.at_rest);

  Relaxation::Options o = options();
  o.time_step = 0.8e-3;  // stable without damping
  EXPECT_THROW((void)Relaxation(o).plan(facts), std::runtime_error);
  o = options();
  o.end_time = 0.5;
  EXPECT_THROW((void)Relaxation(o).plan(facts), std::runtime_error);
}

}  // namespace relaxation_test
