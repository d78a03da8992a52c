// The explicit solver takes equal steps to the end of a stage, none longer than asked, at any
// corners of the loads. It refuses an unstable step.
#include "../../plugins/solvers/explicit/explicit.cpp"

#include <gtest/gtest.h>

#include <random>

namespace explicit_test {
using namespace hyperlattice;

/// Records every step that the solver takes.
struct Notebook {
  std::vector<double> times, steps;
  std::size_t observed = 0, stop_after = ~std::size_t{0};
  SolverHost host;

  explicit Notebook(double start) {
    host.self = this;
    host.time = start;
    host.take_step = [](void* self, double step) noexcept {
      auto& notebook = *static_cast<Notebook*>(self);
      notebook.host.time += step;
      notebook.times.push_back(notebook.host.time);
      notebook.steps.push_back(step);
      return notebook.steps.size() < notebook.stop_after;
    };
    host.show = [](void* self) noexcept {
      ++static_cast<Notebook*>(self)->observed;
      return true;
    };
  }
};

Explicit::Options until(double end) {
  Explicit::Options options;
  options.end_time = end;
  return options;
}

TEST(Explicit, takes_equal_steps_to_the_end) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 200; ++trial) {
    const double start = trial % 2 ? unit(random) : 0, end = start + 0.1 + unit(random),
                 critical = 0.001 + 0.1 * unit(random);
    std::vector<double> corners;
    for (int n = 0; n < 6; ++n) corners.push_back(start - 0.3 + 2 * unit(random));
    std::sort(corners.begin(), corners.end());
    const SolverFacts facts{start, critical, corners};
    const Explicit solver(until(end));
    const SolverPlan plan = solver.plan(facts);
    Notebook notebook(start);
    solver.run(facts, notebook.host);

    EXPECT_EQ(notebook.steps.size(), plan.steps);
    EXPECT_EQ(plan.steps, std::ceil((end - start) / (0.9 * critical)));
    EXPECT_EQ(notebook.observed, plan.steps + 1);
    EXPECT_NEAR(notebook.times.back(), end, 1e-12);
    EXPECT_LE(plan.time_step, 0.9 * critical * (1 + 1e-9));
    for (const double step : notebook.steps) EXPECT_EQ(step, plan.time_step);
  }
}

TEST(Explicit, goes_on_in_the_middle_of_a_stage) {
  Explicit::Options options = until(1);
  options.time_step = 0.1;
  Notebook notebook(0.3);
  notebook.host.steps_done = 3;
  Explicit(options).run({0, 0.2, {}}, notebook.host);
  EXPECT_EQ(notebook.steps.size(), 7u);
  EXPECT_EQ(notebook.observed, 7u);  // the run before has observed the first state
}

TEST(Explicit, a_step_that_divides_the_length_is_taken_as_it_is) {
  Explicit::Options options = until(1);
  options.time_step = 0.1;
  const SolverPlan plan = Explicit(options).plan({0, 0.2, {}});
  EXPECT_EQ(plan.steps, 10u);
  EXPECT_DOUBLE_EQ(plan.time_step, 0.1);
}

TEST(Explicit, damping_lowers_the_stable_step) {
  Explicit::Options options = until(1);
  options.damping = 0.8;
  const SolverPlan plan = Explicit(options).plan({0, 0.01, {}});
  EXPECT_NEAR(plan.stable_time_step, 0.01 * 0.745356, 1e-8);
  EXPECT_LE(plan.time_step, 0.9 * plan.stable_time_step);
  EXPECT_EQ(plan.damping, 0.8);
}

TEST(Explicit, refuses_an_unstable_step_and_names_the_limit) {
  Explicit::Options options = until(1);
  options.time_step = 0.0101;
  try {
    Explicit(options).plan({0, 0.01, {}});
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("at most 0.01 s"), std::string::npos) << error.what();
  }
  options.time_step = 0.0099;
  EXPECT_NO_THROW(Explicit(options).plan({0, 0.01, {}}));
  options.damping = 0.1;
  EXPECT_THROW(Explicit(options).plan({0, 0.01, {}}), std::runtime_error);
}

TEST(Explicit, refuses_to_end_before_it_starts) {
  EXPECT_THROW(Explicit(until(1)).plan({1, 0.01, {}}), std::runtime_error);
}

TEST(Explicit, stops_when_the_host_says_so) {
  Notebook notebook(0);
  notebook.stop_after = 3;
  Explicit(until(1)).run({0, 0.01, {}}, notebook.host);
  EXPECT_EQ(notebook.steps.size(), 3u);
  EXPECT_EQ(notebook.observed, 3u);
}

}  // namespace explicit_test
