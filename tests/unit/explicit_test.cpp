// The explicit solver lands on corners and on the end, keeps to the longest step, and refuses an unstable one.
#include "../../plugins/solvers/explicit/explicit.cpp"

#include <gtest/gtest.h>

#include <random>

using namespace hyperlattice;

namespace {

/// Notes every step that the solver takes.
struct Notebook {
  std::vector<double> times, steps;
  std::size_t observed = 0, stop_after = ~std::size_t{0};
  SolverHost host;

  explicit Notebook(double start) {
    host.self = this;
    host.time = start;
    host.take_step = [](void* self, double step) {
      auto& notebook = *static_cast<Notebook*>(self);
      notebook.host.time += step;
      notebook.times.push_back(notebook.host.time);
      notebook.steps.push_back(step);
      return notebook.steps.size() < notebook.stop_after;
    };
    host.show = [](void* self) {
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

TEST(Explicit, lands_exactly_on_corners_and_on_the_end) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 200; ++trial) {
    const double start = trial % 2 ? unit(random) : 0, end = start + 0.1 + unit(random), critical = 0.001 + 0.1 * unit(random);
    std::vector<double> corners;
    for (int n = 0; n < 6; ++n) corners.push_back(start - 0.3 + 2 * unit(random));
    std::sort(corners.begin(), corners.end());
    const SolverFacts facts{start, critical, corners};
    const Explicit solver(until(end));
    const SolverPlan plan = solver.plan(facts);
    Notebook notebook(start);
    solver.run(facts, notebook.host);

    EXPECT_EQ(notebook.steps.size(), plan.steps);
    EXPECT_EQ(notebook.observed, plan.steps + 1);
    EXPECT_DOUBLE_EQ(notebook.times.back(), end);
    for (const double corner : corners)
      if (corner > start + 1e-6 && corner < end - 1e-6) {
        double nearest = 1;
        for (const double time : notebook.times) nearest = std::min(nearest, std::abs(time - corner));
        EXPECT_LE(nearest, 1e-15 * 4) << "corner " << corner;
      }
    for (const double step : notebook.steps) {
      EXPECT_LE(step, 0.9 * critical * (1 + 1e-9));
      EXPECT_LE(step, plan.time_step * (1 + 1e-9));
      EXPECT_GT(step, 0);
    }
  }
}

TEST(Explicit, a_step_that_divides_the_length_is_taken_as_it_is) {
  Explicit::Options options = until(1);
  options.time_step = 0.1;
  const SolverPlan plan = Explicit(options).plan({0, 0.2, {}});
  EXPECT_EQ(plan.steps, 10u);
  EXPECT_DOUBLE_EQ(plan.time_step, 0.1);
}

TEST(Explicit, corners_that_nearly_coincide_take_no_tiny_step) {
  const double corners[] = {0, 1e-18, 0.5, 0.5 + 1e-14, 1 - 1e-14, 1, 2};
  Notebook notebook(0);
  Explicit(until(1)).run({0, 0.1, corners}, notebook.host);
  for (const double step : notebook.steps) EXPECT_GT(step, 0.05);
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

TEST(Explicit, refuses_to_end_before_it_starts) { EXPECT_THROW(Explicit(until(1)).plan({1, 0.01, {}}), std::runtime_error); }

TEST(Explicit, stops_when_the_host_says_so) {
  Notebook notebook(0);
  notebook.stop_after = 3;
  Explicit(until(1)).run({0, 0.01, {}}, notebook.host);
  EXPECT_EQ(notebook.steps.size(), 3u);
  EXPECT_EQ(notebook.observed, 3u);
}

}  // namespace
