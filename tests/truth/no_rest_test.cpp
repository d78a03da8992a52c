// Bodies without a state of rest: columns buckle at Euler's load and in Euler's mode, and messages
// describe the motion of mechanisms and loose pieces. Also the options for stability, cutbacks and
// line search.
#include <support/rest.hpp>

#include <gtest/gtest.h>

namespace no_rest_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

/// A column of cells, 1 m each, held at its lower end, with more stages.
std::string column(Vec3 size, const Stages& stages) {
  return SceneBuilder{}
      .lattice("lattices.cubic", 1, box({}, size), {{"boundary", "cells"}})
      .stages(elastic(1e9, {{"membrane", "none"}}))
      .load("loads.fixed", {{"on", "z_min"}})
      .stages(stages)
      .text();
}
Stages pressed(double pressure, const Keys& more = {}) {
  return stage("loads.pressure",
               Keys{{"on", "z_max"}, {"facing", "z_max"}, {"pressure", pressure}} + more);
}
Stages force(const char* on, Vec3 total, const Keys& more = {}) {
  return stage("loads.force", Keys{{"on", on}, {"total", total}} + more);
}

struct Failure {
  std::string text;  ///< why the first solver finds no state of rest; "" if it finds one
  std::unique_ptr<Plan> plan;
  std::vector<double> motion, heights;  ///< the failing motion
};
Failure failing(const std::string& scene) {
  Failure failure;
  failure.plan = plan_of(scene, 1);
  Simulation simulation(*failure.plan->model, 1);
  StageCalls::Hooks hooks;
  hooks.failing_motion = [&](const std::vector<double>& motion,
                             const std::vector<double>& heights) {
    failure.motion = motion;
    failure.heights = heights;
  };
  try {
    StageCalls(*failure.plan->model, simulation, failure.plan->stages.front(), 1, std::move(hooks))
        .run();
  } catch (const RunError& error) {
    std::printf("%s\n", error.what());
    failure.text = error.what();
  }
  return failure;
}
std::string failure_of(const std::string& scene) { return failing(scene).text; }

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Reads the number before a word.
double number_before(const std::string& text, const std::string& word) {
  std::size_t from = text.find(word);
  if (from == std::string::npos) return NAN;
  while (from > 0 && std::string("0123456789.").find(text[from - 1]) != std::string::npos) --from;
  return std::stod(text.substr(from));
}

// The column is clamped below and free above. Its load is Euler's pi^2 E I / (4 L^2), reduced for
// shear (Timoshenko, Gere: Theory of elastic stability, 2.17). The springs integrate the square of
// the distance from the axis by the trapezoidal rule, and this leaves an error of second order in
// the cell size. The mode 1 - cos(pi z / 2 L) reaches half of its largest value at two thirds of
// the length.
TEST(NoRest, AColumnBucklesAtEulersLoad) {
  constexpr double young = 1e9, shear = young / 2.5, slenderness = 10, stress = 4e6;
  for (const int n : {4, 8}) {
    const Failure failure =
        failing(column({double(n), double(n), slenderness * n},
                       pressed(stress, {{"rise", 1}}) +
                           stage("solvers.static", {{"load_steps", 4}, {"most_cutbacks", 7}})));
    const std::string& text = failure.text;
    const double area = n * n, euler = M_PI * M_PI * young * area * area / 12 /
                                       (4 * std::pow(slenderness * n, 2));
    const double expected = euler / (1 + euler / (5.0 / 6 * shear * area));
    const double found = number_before(text, "% of the load") / 100 * stress * area;
    std::printf("%d cells across: buckles at %.4f of the expected load\n", n, found / expected);
    EXPECT_NEAR(found / expected, 1, 1.5 / (n * n));
    EXPECT_TRUE(says(text, "buckles")) << text;
    EXPECT_TRUE(says(text, ", " + std::to_string(10 * n) + ") m"))
        << text;  // the motion is largest at the free end
    EXPECT_NEAR(number_before(text, "% of the particles"), 33, 4);
    double alike = 0, kept = 0, mode = 0;  // along the motion of the free end
    const Body& body = failure.plan->model->body;
    ASSERT_EQ(failure.motion.size(), 3 * body.particles);
    const double* end = failure.motion.data() + 3 * (body.particles - 1);
    for (Particle p = 0; p < body.particles; ++p) {
      const double across = failure.motion[3 * p] * end[0] + failure.motion[3 * p + 1] * end[1];
      const double expected_there = 1 - std::cos(M_PI * body.position(p).z / (2 * slenderness * n));
      alike += across * expected_there;
      kept += across * across;
      mode += expected_there * expected_there;
    }
    std::printf("correlation with Euler's mode: %.6f\n", alike / std::sqrt(kept * mode));
    EXPECT_GT(alike, 0.999 * std::sqrt(kept * mode));
  }
}

// The option `stability` turns the check for buckling off.
TEST(NoRest, AStraightColumnMayBeAskedToStayStraight) {
  const AtRest straight(
      column({4, 4, 40}, pressed(2.6e6) + stage("solvers.static", {{"stability", false}})));
  EXPECT_NEAR(straight.mean(2, [](Site s) { return s.k == 40; }), -2.6e6 / 1e9 * 40, 0.01 * 0.104);
  EXPECT_NEAR(straight.mean(0, [](Site s) { return s.k == 40; }), 0, 1e-6);
}

// One load step bends the beam by more than a right angle. Full Newton steps fail there; steps
// shortened by the line search succeed.
TEST(NoRest, ShorterStepsFindWhatWholeOnesMiss) {
  const auto bent = [](const Keys& keys) {
    return AtRest(column({2, 2, 40}, force("z_max", {1e7, 0, 0}) +
                                         stage("solvers.static", keys + Keys{{"tolerance", 1e-9}})))
        .u;
  };
  const auto at_once = bent({{"most_cutbacks", 0}});
  const auto in_steps = bent({{"load_steps", 25}});
  EXPECT_GT(largest(at_once), 20);
  EXPECT_LT(distance(at_once, in_steps), 1e-6 * largest(in_steps));
}

TEST(NoRest, ABodyThatNothingHoldsIsToldHowItMoves) {
  const auto pulled = [](const Stages& more) {
    return scene({{"spacing", 1}, {"shape", box({}, {4, 4, 4})}},
                 elastic(1e9, {{"membrane", "I-m"}, {"poisson", 0.1}}) + more + to_rest);
  };
  const Stages pull = force("z_max", {0, 0, 1e3});
  const Stages guided = stage("loads.fixed", {{"on", "x_min"}, {"axes", "x"}}) +
                        stage("loads.fixed", {{"on", "y_min"}, {"axes", "y"}});
  for (const Stages& supports : {Stages{}, guided})
    EXPECT_TRUE(says(failure_of(pulled(pull + supports)),
                     "the whole body can move as a rigid one: it slides along (0, 0, 1)"));
  const Stages couple =
      force("x_min", {0, -1e3, 0}) + force("x_max", {0, 1e3, 0}, {{"name", "other"}});
  const Failure turns = failing(pulled(couple));
  EXPECT_TRUE(says(turns.text, "it turns about the axis (0, 0, 1) through (2, 2, 2) m"));
  const Body& body = turns.plan->model->body;
  ASSERT_EQ(turns.motion.size(), 3 * body.particles);
  // The rate of the last particle, at (3.5, 3.5, 3.5) m.
  const double rate = turns.motion[3 * body.particles - 2] / 1.5;
  EXPECT_GT(rate, 0);
  for (Particle p = 0; p < body.particles; ++p) {
    const Vec3 from = body.position(p) - Vec3{2, 2, 2};
    EXPECT_NEAR(turns.motion[3 * p], -rate * from.y, 1e-9 * rate);
    EXPECT_NEAR(turns.motion[3 * p + 1], rate * from.x, 1e-9 * rate);
  }
}

std::string two_blocks(Vec3 low, Vec3 high) {
  return SceneBuilder{}
      .lattice("lattices.cubic", 1e-3, {{"union", {box_mm(4, 4, 4), box(low, high)}}},
               {{"anchor", {0, 0, 0}}})
      .stages(elastic(1e9, {{"membrane", "none"}}))
      .load("loads.fixed", {{"on", "x_min"}})
      .stages(force("x_max", {0, 0, 1}))
      .solver("solvers.static", {{"most_cutbacks", 2}})
      .text();
}

TEST(NoRest, ALoosePieceIsNamed) {
  const std::string text = failure_of(two_blocks({8e-3, 0, 0}, {12e-3, 4e-3, 4e-3}));
  EXPECT_TRUE(says(text, "a loose piece of 64 of the 128 particles, around (0.01, 0.002, 0.002) m"))
      << text;
  EXPECT_TRUE(says(text, "turns about the axis (0, -1, 0)"))
      << text;  // the force does not pass through the centre of the piece
}

// Only the four springs between two edges join the blocks.
TEST(NoRest, AMechanismIsAnErrorThatSaysWhereItMoves) {
  const std::string text = failure_of(two_blocks({4e-3, 4e-3, 0}, {8e-3, 8e-3, 4e-3}));
  EXPECT_TRUE(says(text, "no state of rest under its loads")) << text;
  EXPECT_TRUE(says(text, "motion is largest at")) << text;
  // The turning block holds 64 of the 112 free particles.
  EXPECT_LE(number_before(text, "% of the particles"), 58);
}

}  // namespace no_rest_test
