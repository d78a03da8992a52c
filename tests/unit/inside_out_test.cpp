// Cells that are inside out are counted and located. Turned or strained cells are not.
#include <state/inside_out.hpp>
#include <support/lists.hpp>

#include <gtest/gtest.h>

#include <optional>

namespace inside_out_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

struct Watched {
  explicit Watched(const std::string& scene)
      : plan(plan_of(scene, 1)), simulation(*plan->model, 1), watch(std::in_place, *plan->model) {}
  /// Moves each particle to the place that `to` returns.
  template <class To>
  const InsideOut& look(const To& to) {
    std::vector<double> u;
    for (Particle p = 0; p < plan->model->body.particles; ++p) {
      const Vec3 x = plan->model->body.position(p), d = to(x) - x;
      u.insert(u.end(), {d.x, d.y, d.z});
    }
    simulation.set_displacements(u, {});
    watch.emplace(*plan->model);
    watch->look(simulation);
    return watch->seen();
  }
  std::unique_ptr<Plan> plan;
  Simulation simulation;
  std::optional<CellWatch> watch;
};

std::string lattice(const std::string& type, const Keys& more = {}) {
  return listed_scene(stage(type, Keys{{"spacing", "1 mm"}, {"shape", box_mm(6, 5, 4)}} + more),
                      {{"membrane", "none"}});
}

Vec3 same(Vec3 x) { return x; }
Vec3 turned(Vec3 x) { return {-x.y, x.x, x.z}; }
Vec3 stretched(Vec3 x) { return {3 * x.x, 0.1 * x.y, x.z + 2 * x.x}; }
Vec3 mirrored(Vec3 x) { return {x.x, x.y, -x.z}; }
Vec3 flattened(Vec3 x) { return {x.x, x.y, -0.01 * x.z}; }

TEST(InsideOut, AnyLatticeMayBeTurnedAndStrainedButNotMirrored) {
  for (const char* type : {"lattices.cubic", "lattices.bcc", "lattices.fcc", "lattices.random"}) {
    Watched body(lattice(type));
    for (const auto& to : {same, turned, stretched}) {
      EXPECT_EQ(body.look(to).number, 0u) << type;
      EXPECT_EQ(body.watch->sentence(), "") << type;
    }
    for (const auto& to : {mirrored, flattened}) {
      const InsideOut& seen = body.look(to);
      EXPECT_GT(seen.all, 20u) << type;
      EXPECT_EQ(seen.number, seen.all) << type;
      EXPECT_NE(body.watch->sentence().find("folds through itself"), std::string::npos) << type;
    }
  }
}

TEST(InsideOut, OneParticleThatGoesThroughItsNeighboursTurnsItsCells) {
  Watched body(lattice("lattices.cubic", {{"boundary", "cells"}}));
  const Vec3 inner{2e-3, 3e-3, 2e-3};
  const auto pushed = [&](double by) {
    return body.look([&](Vec3 x) { return norm(x - inner) < 1e-6 ? x + Vec3{by, 0, 0} : x; });
  };
  EXPECT_EQ(pushed(0.9e-3).number, 0u);
  // The particle passes its neighbour, so that the four cells between them turn inside out.
  const InsideOut seen = pushed(1.1e-3);
  EXPECT_EQ(seen.number, 4u);
  EXPECT_EQ(seen.all, 120u);
  EXPECT_NEAR(norm(seen.first_place - Vec3{2e-3, 2e-3, 1e-3}), 0, 1e-9);
  EXPECT_NE(body.watch->sentence().find("4 of 120 cells are inside out"), std::string::npos)
      << body.watch->sentence();
}

TEST(InsideOut, AGapOrAHoleIsNoCell) {
  const Json shape = {
      {"difference", {box_mm(6, 3, 3), box({2e-3, 1e-3, 1e-3}, {3e-3, 2e-3, 2e-3})}}};
  Watched body(listed_scene(stage("lattices.cubic", {{"spacing", "1 mm"}, {"shape", shape}}),
                            {{"membrane", "none"}}));
  EXPECT_EQ(body.look(same).all, 5u * 2 * 2 - 8);
}

TEST(InsideOut, CompressedCellsWithAVolumetricEnergyAreToldWithTheShorterStep) {
  const auto compressed = [](Vec3 x) { return Vec3{x.x, x.y, 0.5 * x.z}; };
  const std::string box =
      listed_scene(stage("lattices.cubic", {{"spacing", "1 mm"}, {"shape", box_mm(6, 5, 4)}}),
                   {{"membrane", "none"}, {"poisson", 0.4}});
  Watched body(box), springs(lattice("lattices.cubic"));
  EXPECT_NEAR(body.look(compressed).least_volume, 0.5, 1e-12);
  // p' = y^4 (2 y - 1) with y^3 = 2 is 3.8296.
  EXPECT_NE(body.watch->stiffened().find("0.5 of its volume"), std::string::npos);
  EXPECT_NE(body.watch->stiffened().find("up to 2 times smaller"), std::string::npos)
      << body.watch->stiffened();
  EXPECT_EQ(body.look(same).least_volume, 1);
  EXPECT_EQ(body.watch->stiffened(), "");
  springs.look(compressed);
  EXPECT_EQ(springs.watch->stiffened(), "") << "springs alone do not stiffen";
}

}  // namespace inside_out_test
