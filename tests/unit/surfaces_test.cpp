// The particles and faces that belong to named surfaces, single faces and sets of regions.
#include <model/surfaces.hpp>

#include <support/body.hpp>

#include <gtest/gtest.h>

#include <bit>
#include <numbers>

namespace surfaces_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

using Part = std::shared_ptr<const Region>;

Part named(const char* name) { return built_in_region(name); }
Part sphere(double radius) { return std::make_shared<Region>(ball(0, radius)); }

std::size_t count(const Body& body, const Surfaces& surfaces, const Region& region) {
  return particles_in(body, surfaces, region).size();
}

TEST(Surfaces, PapersCavityHas4344Particles) {
  const Body body = cubic_body(ball(20e-3, 50e-3), 1e-3);
  const Surfaces surfaces(body);
  const std::vector<Particle> inner = particles_in(body, surfaces, *named("inner_surface"));
  EXPECT_EQ(inner.size(), 4344u);
  for (const Particle p : inner) ASSERT_LT(norm(body.position(p)), 22e-3);
  const std::size_t outer = count(body, surfaces, *named("outer_surface"));
  EXPECT_EQ(count(body, surfaces, *named("surface")), inner.size() + outer);
  EXPECT_EQ(count(body, surfaces, *named("all")), body.particles);
}

// The area vectors of a closed surface have the sum zero.
TEST(Surfaces, OpenAreasCloseTheSurface) {
  for (const Boundary boundary : {Boundary::particles, Boundary::cells}) {
    const Body body = cubic_body(ball(4, 9), 1, boundary);
    const Surfaces surfaces(body);
    for (const char* name : {"inner_surface", "outer_surface"}) {
      Vec3 sum;
      double size = 0;
      for (const OpenArea& open : open_areas(body, surfaces, *named(name))) {
        sum = sum + open.area;
        size += norm(open.area);
      }
      EXPECT_EQ(sum, Vec3{}) << name;
      EXPECT_GT(size, 4 * std::numbers::pi * 14) << name;
    }
  }
}

TEST(Surfaces, ACavityWithADoorIsOutside) {
  const auto with_door = [](bool door) {
    return cubic_body(solid({}, {5, 5, 5},
                            [door](Vec3 p) {
                              const bool hole = std::abs(p.x - 2.5) < 1 &&
                                                std::abs(p.y - 2.5) < 1 && std::abs(p.z - 2.5) < 1;
                              return !hole && !(door && p.x > 3 && std::abs(p.y - 2.5) < 0.9 &&
                                                std::abs(p.z - 2.5) < 0.9);
                            }),
                      1);
  };
  const Body closed = with_door(false), open = with_door(true);
  EXPECT_EQ(count(closed, Surfaces(closed), *named("inner_surface")), 6u);
  EXPECT_EQ(count(open, Surfaces(open), *named("inner_surface")), 0u);
  EXPECT_EQ(count(open, Surfaces(open), *named("surface")),
            count(open, Surfaces(open), *named("outer_surface")));
}

TEST(Surfaces, FacesAreTheOutermostLayerAndLookOneWay) {
  const Body body = cubic_body(box({4, 5, 6}), 1);
  const Surfaces surfaces(body);
  const std::pair<const char*, std::size_t> sides[] = {{"x_min", 30}, {"x_max", 30}, {"y_min", 24},
                                                       {"y_max", 24}, {"z_min", 20}, {"z_max", 20}};
  for (int direction = 0; direction < 6; ++direction) {
    const auto& [name, expected] = sides[direction];
    const Part side = named(name);
    EXPECT_EQ(count(body, surfaces, *side), expected) << name;
    const auto areas = open_areas(body, surfaces, *side);
    EXPECT_EQ(areas.size(), expected) << name;
    for (const OpenArea& open : areas) EXPECT_EQ(open.area, face_normals[direction]) << name;
  }
  EXPECT_EQ(std::popcount(surfaces.faces({0, 0, 0})), 3);
  EXPECT_EQ(surfaces.faces({1, 1, 1}), 0u);
}

TEST(Surfaces, SetsOfSurfacesAndSolids) {
  const Body body = cubic_body(ball(4, 9), 1);
  const Surfaces surfaces(body);
  const auto number = [&](Region::Kind kind, std::vector<Part> parts) {
    return count(body, surfaces, *make_set(kind, std::move(parts)));
  };
  const std::size_t inner = count(body, surfaces, *named("inner_surface")),
                    outer = count(body, surfaces, *named("outer_surface"));
  EXPECT_EQ(number(Region::Kind::set_union, {named("inner_surface"), named("outer_surface")}),
            inner + outer);
  EXPECT_EQ(number(Region::Kind::intersection, {named("inner_surface"), named("outer_surface")}),
            0u);
  EXPECT_EQ(number(Region::Kind::difference, {named("surface"), named("outer_surface")}), inner);
  EXPECT_EQ(number(Region::Kind::intersection, {named("surface"), sphere(7)}), inner);
  EXPECT_EQ(number(Region::Kind::difference, {named("all"), sphere(7)}) +
                count(body, surfaces, *sphere(7)),
            body.particles);

  const Part near = make_set(Region::Kind::intersection, {named("inner_surface"), sphere(7)});
  const auto areas = open_areas(body, surfaces, *near);
  EXPECT_EQ(areas.size(), inner);
  for (const OpenArea& open : areas) {
    Vec3 expected;
    for (unsigned face = 0; face < 6; ++face)
      if ((surfaces.inner_faces(body.site(open.particle)) >> face & 1U) != 0)
        expected = expected + face_normals[face];
    EXPECT_EQ(open.area, expected);
  }
}

}  // namespace surfaces_test
