// Springs with scattered stiffness: the stiffnesses follow Weibull's distribution, and the
// stiffness of bodies agrees with theory.
#include <model/spring_calls.hpp>
#include <support/laws.hpp>

#include <gtest/gtest.h>

namespace scattered_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr double modulus = 3;
const double mean = std::tgamma(1 + 1 / modulus),
             variance = std::tgamma(1 + 2 / modulus) / (mean * mean) - 1;

const Keys no_membrane = {{"membrane", "none"}},
           membrane_I_m = {{"membrane", "I-m"}, {"poisson", 0.1}};

Keys scattered(const Keys& membrane, double m, int seed) {
  return Keys{{"type", "materials.scattered"}, {"modulus", m}, {"seed", seed}} + membrane;
}
Stages cube(int n, const char* boundary) {
  return stage("lattices.cubic",
               {{"spacing", 1e-3}, {"boundary", boundary}, {"shape", box_mm(n, n, n)}});
}

/// Stiffness of each base spring over the mean stiffness, from the force of this spring alone.
std::vector<double> shares(const Model& model) {
  std::vector<double> found;
  model.body.for_springs([&](Particle a, Particle b, std::uint32_t n) {
    const SpringProperties properties = model.spring_properties(a, b, n);
    double kept[max_spring_memory] = {};
    start_memory_of(model, properties, 0, {std::min(a, b), std::max(a, b)}, kept);
    found.push_back(take_spring(model, properties, 0, 1e-7, 0, kept).force /
                    (properties.stiffness * 1e-7));
  });
  return found;
}

TEST(Scattered, SharesAreWeibulls) {
  const auto plan = plan_of(law_scene(cube(20, "particles"), scattered(no_membrane, modulus, 1)));
  std::vector<double> found = shares(*plan->model);
  std::sort(found.begin(), found.end());
  const auto number = static_cast<double>(found.size());
  double sum = 0, squares = 0, farthest = 0;
  for (std::size_t n = 0; n < found.size(); ++n) {
    sum += found[n];
    squares += (found[n] - 1) * (found[n] - 1);
    farthest = std::max(farthest, std::abs(1 - std::exp(-std::pow(found[n] * mean, modulus)) -
                                           (static_cast<double>(n) + 0.5) / number));
  }
  EXPECT_NEAR(sum / number, 1, 4 * std::sqrt(variance / number));
  EXPECT_NEAR(squares / number, variance, 0.03 * variance);
  // Bound of Kolmogorov and Smirnov, which one sample in a thousand exceeds.
  EXPECT_LT(farthest, 1.95 / std::sqrt(number));
}

/// The modulus of a bar over that of a bar with equal springs.
double stiffness_of_bar(int seed, std::unique_ptr<Plan>& plan) {
  constexpr double strain = 1e-6;
  const auto moved = [](const char* on, double by, double rise) {
    return stage("loads.displacement",
                 {{"on", on}, {"value", Vec3{by, 0, 0}}, {"axes", "x"}, {"rise", rise}});
  };
  plan = plan_of(law_scene(cube(8, "cells"), scattered(no_membrane, modulus, seed),
                           moved("x_min", 0, 1e-6) + moved("x_max", 8e-9, 4e-5)));
  Simulation simulation(*plan->model, 1);
  simulation.set_damping(0.7);
  while (simulation.time() < 1e-4) simulation.step(0.9 * plan->model->step_limit.time_step);
  return std::abs(simulation.force_on_load()[1].x) / 64e-6 / strain / 1e10;
}

// Theory to first order in the variance v: the mean modulus is lower by v / 3. The variance of the
// modulus is v times the sum of the squares of the springs' parts of the energy.
TEST(Scattered, BarsAreAsStiffAsTheoryHasIt) {
  constexpr int number = 60;
  double sum = 0, squares = 0;
  std::unique_ptr<Plan> plan;
  for (int seed = 1; seed <= number; ++seed) {
    const double found = stiffness_of_bar(seed, plan);
    sum += found;
    squares += found * found;
  }
  double held = 0, held_squares = 0;  // energy of each spring in a bar of equal springs, any unit
  const Model& model = *plan->model;
  model.body.for_springs([&](Particle a, Particle b, std::uint32_t n) {
    const SpringProperties properties = model.spring_properties(a, b, n);
    const double growth =
        properties.rest.x * properties.rest.x -
        0.25 * (properties.rest.y * properties.rest.y + properties.rest.z * properties.rest.z);
    const double energy =
        properties.share * growth * growth / dot(properties.rest, properties.rest);
    held += energy;
    held_squares += energy * energy;
  });
  const double average = sum / number,
               scatter = (squares / number - average * average) * number / (number - 1),
               expected_scatter = variance * held_squares / (held * held);
  std::printf("mean 1 - %.3f v, variance %.2f of that expected\n", (1 - average) / variance,
              scatter / expected_scatter);
  EXPECT_LT(average, 1);
  EXPECT_GT(average, 1 - variance);
  EXPECT_NEAR((1 - average) / variance, 1.0 / 3, 0.06);
  EXPECT_NEAR(scatter / expected_scatter, 1, 0.5);
}

// On a grid, the random numbers follow the particles, wherever blocks are cut. On a list, they
// follow the order of the points in the file.
TEST(Scattered, AnotherSeedIsAnotherBodyAndTheSameOneTheSame) {
  const auto hash = [](int seed, int threads) {
    return shaken(*plan_of(law_scene(cube(7, "particles"), scattered(membrane_I_m, 8, seed))), 0.4,
                  50, threads)
        .hash;
  };
  const std::uint64_t one = hash(1, 1);
  for (const int threads : {1, 2, 3, 6}) EXPECT_EQ(hash(1, threads), one);
  EXPECT_NE(hash(2, 1), one);
}

TEST(Scattered, StaysStableUpToItsStep) {
  const auto plan = plan_of(law_scene(cube(6, "particles"), scattered(membrane_I_m, modulus, 1)));
  const Ended ended = shaken(*plan, 0.99, 3000, 1, 1e-6);
  EXPECT_LT(std::abs(ended.balance.relative_error()), 1e-6);
}

}  // namespace scattered_test
