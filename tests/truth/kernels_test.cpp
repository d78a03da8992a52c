// The fast kernel against the exact kernel (HYPERLATTICE_SPRINGS=exact: one neighbour at a time,
// with root and division), against itself on other numbers of threads, and floats against doubles.
// Strains have every size; bodies have holes, rows of every length, cells, several materials, and
// breaking springs.
#include <support/scenes.hpp>

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

namespace kernels_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

/// Simulations use the exact kernel while this object lives.
struct ExactKernel {
  ExactKernel() { setenv("HYPERLATTICE_SPRINGS", "exact", 1); }
  ~ExactKernel() { unsetenv("HYPERLATTICE_SPRINGS"); }
};

struct ShapeCase {
  const char* name;
  Json shape;  ///< lengths in spacings, here 1 m
};
Json sphere(double radius) { return {{"sphere", {{"radius", radius}}}}; }
const ShapeCase shapes[] = {
    {"box", box({}, {35, 5, 6})},
    {"whole_vectors", box({}, {16, 4, 4})},
    {"column", box({}, {1, 3, 9})},
    {"sheet", box({}, {25, 1, 7})},
    {"hollow_sphere", {{"difference", {sphere(9.2), sphere(4.1)}}}},
    {"leaning", {{"cylinder", {{"start", {0, 0, 0}}, {"end", {20, 6, 9}}, {"radius", 3.3}}}}},
};

struct Variant {
  const char* name;
  const char* material;
  const char* more;  ///< more stages
};
const Variant variants[] = {
    {"three", R"("membrane": "none", "poisson": 0.25)", ""},
    {"clamped", R"("membrane": "III", "lambda": 2)", ""},
    {"free", R"("membrane": "I-m", "poisson": 0.1)", ""},
    {"breakable",
     R"("membrane": "I-m", "poisson": 0.1, "failure": { "type": "failures.elongation", "limit": 1e-3 })",
     ""},
    {"two_materials", R"("membrane": "I-m", "poisson": 0.1)",
     R"(, { "type": "materials.elastic", "young": 3e9, "density": 900, "membrane": "I-m", "poisson": 0.2,
          "region": { "half_space": { "point": [0, 2.2, 2.2], "normal": [0.1, 0.5, 1] } } })"},
    {"falling", R"("membrane": "none", "poisson": 0.25)",
     R"(, { "type": "loads.gravity", "acceleration": [3, 0, -9.81] })"},
};

class Kernels : public testing::TestWithParam<std::tuple<ShapeCase, Variant, const char*>> {
 protected:
  /// A plan of the case, spacing 1 m.
  std::unique_ptr<Plan> plan(const char* precision = "double") const {
    const auto& [shape, variant, boundary] = GetParam();
    return plan_of(SceneBuilder{}
                       .key("precision", precision)
                       .lattice("lattices.cubic", 1, shape.shape,
                                {{"boundary", boundary}, {"anchor", {0, 0, 0}}})
                       .material("materials.elastic",
                                 Keys{{"young", 1e10}, {"density", 2500}} + variant.material)
                       .stages(variant.more)
                       .solver("solvers.explicit", {{"end_time", 1}})
                       .text());
  }
};
INSTANTIATE_TEST_SUITE_P(All, Kernels,
                         testing::Combine(testing::ValuesIn(shapes), testing::ValuesIn(variants),
                                          testing::Values("particles", "cells")),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param).name) + "_" +
                                  std::get<1>(info.param).name + "_" + std::get<2>(info.param);
                         });

/// Sets random displacements, and random heights if the membrane is free.
void disturb(Simulation& simulation, const Model& model, double size) {
  const std::size_t particles = model.body.particles;
  simulation.set_displacements(noise(3 * particles, size, 1), model.degrees_of_freedom == 4
                                                                  ? noise(particles, size, 2)
                                                                  : std::vector<double>{});
}

struct Moved {
  std::vector<double> velocity, rate;
  std::uint64_t hash = 0;
  std::size_t broken = 0;
};
Moved moved(const Model& model, double size, int steps, int threads) {
  Simulation simulation(model, threads);
  disturb(simulation, model, size);
  for (int n = 0; n < steps; ++n) simulation.step(0.3 * model.step_limit.time_step);
  Moved moved;
  simulation.velocities(moved.velocity);
  simulation.height_rates(moved.rate);
  moved.hash = simulation.hash();
  moved.broken = simulation.breakages().size();
  return moved;
}

TEST_P(Kernels, GiveTheForcesOfThePlainOne) {
  const auto scene = plan();
  for (const double size : {1e-12, 1e-6, 2e-3, 0.02, 0.3}) {
    const Moved fast = moved(*scene->model, size, 1, 1);
    const ExactKernel exact;
    const Moved plain = moved(*scene->model, size, 1, 1);
    const double scale = std::max(largest(plain.velocity), largest(plain.rate));
    ASSERT_GT(scale, 0);
    EXPECT_LT(distance(fast.velocity, plain.velocity), 4e-15 * scale) << size;
    EXPECT_LT(distance(fast.rate, plain.rate), 4e-15 * scale) << size;
    EXPECT_EQ(fast.broken, plain.broken) << size;
  }
}

TEST_P(Kernels, InFloatsGiveTheForcesOfDoubles) {
  const auto doubles = plan(), floats = plan("float");
  for (const double size : {1e-12, 1e-6, 2e-3, 0.02, 0.3}) {
    const Moved fast = moved(*floats->model, size, 1, 1);
    const ExactKernel exact;
    const Moved plain = moved(*doubles->model, size, 1, 1),
                plain_floats = moved(*floats->model, size, 1, 1);
    const double scale = std::max(largest(plain.velocity), largest(plain.rate));
    for (const Moved* other : {&fast, &plain_floats}) {
      EXPECT_LT(distance(other->velocity, plain.velocity), 1.5e-6 * scale) << size;
      EXPECT_LT(distance(other->rate, plain.rate), 1.5e-6 * scale) << size;
      EXPECT_EQ(other->broken, plain.broken) << size;
    }
  }
}

TEST_P(Kernels, GiveTheSameBitsForAnyNumberOfThreads) {
  for (const char* precision : {"double", "float"}) {
    const auto scene = plan(precision);
    for (const double size : {1e-6, 0.02}) {
      const Moved one = moved(*scene->model, size, 8, 1);
      for (const int threads : {2, 3, 5})
        EXPECT_EQ(moved(*scene->model, size, 8, threads).hash, one.hash)
            << size << ", " << threads << " threads";
    }
  }
}

}  // namespace kernels_test
