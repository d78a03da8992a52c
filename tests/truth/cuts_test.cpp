// Bodies that are cut through: the parts against the same parts alone, and parts that fly apart
// without a force.
#include <model/body_figures.hpp>
#include <state/simulation.hpp>
#include <support/cuts.hpp>
#include <support/models.hpp>

#include <gtest/gtest.h>

namespace cuts_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

/// A body after some steps of half the critical length.
struct Moved {
  BuiltScene built;
  std::unique_ptr<Simulation> simulation;
  std::vector<double> u;  ///< displacements, m

  Moved(const Stages& pipeline, int steps, int threads = 1)
      : built(build(pipeline)), simulation(std::make_unique<Simulation>(*built, threads)) {
    for (int n = 0; n < steps; ++n) simulation->step(0.5 * built->step_limit.time_step);
    simulation->displacements(u);
  }
  const Body& body() const { return built->body; }
  Vec3 moved(Particle p) const { return {u[3 * p], u[3 * p + 1], u[3 * p + 2]}; }
};

struct LatticeCase {
  const char* type;
  Keys more;
  Keys material;
};
const LatticeCase lattices[] = {
    {"lattices.cubic", {}, {{"poisson", 0.25}}},
    {"lattices.cubic", {}, {{"poisson", 0.35}}},
    {"lattices.cubic", {}, {{"membrane", "I-m"}, {"poisson", 0.1}}},
    {"lattices.cubic", {{"boundary", "cells"}}, {{"poisson", 0.3}}},
    {"lattices.cubic",
     {{"boundary", "partial_cells"}, {"anchor", {3e-4, 2e-4, 4e-4}}},
     {{"poisson", 0.3}}},
    {"lattices.bcc", {}, {{"poisson", 0.25}}},
    {"lattices.fcc", {}, {{"poisson", 0.25}}},
    {"lattices.random", {}, {}},
    {"lattices.random", {}, {{"poisson", 0.35}}},
};

Stages body(const LatticeCase& of, const Json& shape, const Json& cuts) {
  return stage(of.type, Keys{{"spacing", 1e-3}, {"shape", shape}, {"cuts", cuts}} + of.more) +
         stage("materials.elastic", Keys{{"young", 1e10}, {"density", 2500}} + of.material);
}

/// A bar along x under forces at both ends, cut at x = 8 mm, against the part below 8 mm alone. Its
/// displacements have the same bits, as no spring acts between the parts.
TEST(Cuts, PartsMoveAsIfTheyWereAlone) {
  for (std::size_t n = 0; n < 3; ++n) {
    const LatticeCase& of = lattices[n];
    const auto pulled = [](const char* on, const Json& each) {
      return stage("loads.force", {{"on", on}, {"each", each}});
    };
    const Moved cut(body(of, box_mm(15, 5, 4), Json::array({plane({8e-3, 0, 0}, {1, 0, 0})})) +
                        pulled("x_min", {-3e-2, 1e-2, 0}) + pulled("x_max", {5e-2, 0, 2e-2}),
                    200);
    const Moved alone(body(of, box_mm(8, 5, 4), Json::array()) + pulled("x_min", {-3e-2, 1e-2, 0}),
                      200);
    EXPECT_EQ(parts_of(cut.body()).count, 2U);
    double farthest = 0;
    for (Particle p = 0; p < alone.body().particles; ++p) {
      ASSERT_EQ(cut.moved(cut.body().at(alone.body().site(p))), alone.moved(p)) << n;
      farthest = std::max(farthest, norm(alone.moved(p)));
    }
    EXPECT_GT(farthest, 1e-9);
    EXPECT_EQ(cut.simulation->broken(), 0U);
  }
}

/// A tilted plane through particles, or past them, cuts a block in two. The parts are thrown
/// sideways: they keep their velocities, since nothing holds them together.
TEST(Cuts, PartsFlyApartWithoutForce) {
  const Vec3 point{5e-3, 4.5e-3, 4.5e-3}, normal{1, 1, 0}, velocity{0.3, -0.2, 0.4};
  const Json behind = {{"half_space", {{"point", point + 1e-9 * normal}, {"normal", normal}}}};
  const auto thrown = [](const Json& on, Vec3 linear) {
    return stage("loads.start_velocity", {{"on", on}, {"linear", linear}});
  };
  for (const LatticeCase& of : lattices)
    for (const int threads : {1, 3}) {
      const Moved apart(body(of, box_mm(10, 9, 8), Json::array({plane(point, normal)})) +
                            thrown(behind, -velocity) +
                            thrown({{"difference", Json::array({"all", behind})}}, velocity),
                        300, threads);
      EXPECT_EQ(parts_of(apart.body()).count, 2U) << of.type;
      const double time = apart.simulation->time();
      EXPECT_GT(time * norm(velocity), 1e-5);
      Vec3 momentum, at_start;
      double off = 0, mass = 0;
      for (Particle p = 0; p < apart.body().particles; ++p) {
        const double height = dot(apart.body().position(p) - point, normal);
        const Vec3 expected = height > 1e-9 ? velocity : -velocity;
        off = std::max(off, norm(apart.moved(p) - time * expected));
        mass += apart.built->mass(p);
        at_start += apart.built->mass(p) * expected;
        momentum += apart.built->mass(p) / time * apart.moved(p);
      }
      EXPECT_LT(off, 1e-8 * time * norm(velocity)) << of.type << of.material.json();
      EXPECT_LT(norm(momentum - at_start), 1e-9 * mass * norm(velocity)) << of.type;
      EXPECT_LT(apart.simulation->balance().stored, 1e-9 * mass * dot(velocity, velocity));
    }
}

}  // namespace cuts_test
