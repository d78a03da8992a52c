// Bodies of cells: particles, springs and shares, and the corners of cells that belong to regions
// and surfaces.
#include <model/surfaces.hpp>

#include <support/body.hpp>

#include <gtest/gtest.h>

#include <numbers>

namespace cells_surfaces_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

using Part = std::shared_ptr<const Region>;

Part named(const char* name) { return built_in_region(name); }
Part box_between(Vec3 low, Vec3 high) {
  return std::make_shared<Region>(solid(low, high, [=](Vec3 p) {
    return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y && low.z <= p.z &&
           p.z <= high.z;
  }));
}

struct CellBody {
  Body body;
  Surfaces surfaces{body};
  explicit CellBody(const Region& region, double spacing = 1)
      : body(cubic_body(region, spacing, Boundary::cells)) {}
  CellBody(const CellBody&) = delete;
  CellBody& operator=(const CellBody&) = delete;

  std::size_t count(const Part& region) const {
    return particles_in(body, surfaces, *region).size();
  }
  Vec3 area(const Part& region) const {
    Vec3 sum;
    for (const OpenArea& open : open_areas(body, surfaces, *region)) sum = sum + open.area;
    return sum;
  }
  Particle at(Vec3 x) const {
    for (Particle p = 0; p < body.particles; ++p)
      if (norm(body.position(p) - x) < 1e-9) return p;
    return Body::no_particle;
  }
};

TEST(CellBody, HasCornersAndEdgesOfItsCells) {
  const CellBody b(box({3, 4, 5}));
  EXPECT_EQ(b.body.cells.count(), 60u);
  EXPECT_EQ(b.body.particles, 4u * 5 * 6);
  EXPECT_EQ(b.body.springs[0], 3u * 5 * 6 + 4 * 4 * 6 + 4 * 5 * 5);
  EXPECT_EQ(b.body.springs[1], 2u * (3 * 4 * 6 + 3 * 5 * 5 + 4 * 4 * 5));
  EXPECT_EQ(b.body.position(Particle{0}), (Vec3{0, 0, 0}));
  EXPECT_EQ(b.body.position(b.body.particles - 1), (Vec3{3, 4, 5}));
}

TEST(CellBody, SharesGoByTheCellsThatAreThere) {
  const CellBody b(box({3, 4, 5}));
  const Neighbour along_x{1, 0, 0, 0}, diagonal_xy{1, 1, 0, 1}, diagonal_yz{0, -1, 1, 1};
  EXPECT_EQ(b.body.share({0, 0, 0}), 1.0 / 8);
  EXPECT_EQ(b.body.share({1, 0, 0}), 2.0 / 8);
  EXPECT_EQ(b.body.share({1, 1, 0}), 4.0 / 8);
  EXPECT_EQ(b.body.share({1, 1, 1}), 1.0);
  EXPECT_EQ(b.body.share({0, 0, 0}, along_x), 1.0 / 4);
  EXPECT_EQ(b.body.share({0, 1, 0}, along_x), 2.0 / 4);
  EXPECT_EQ(b.body.share({0, 1, 1}, along_x), 1.0);
  EXPECT_EQ(b.body.share({0, 0, 0}, diagonal_xy), 1.0 / 2);
  EXPECT_EQ(b.body.share({0, 0, 1}, diagonal_xy), 1.0);
  EXPECT_EQ(b.body.share({0, 2, 0}, diagonal_yz), 1.0 / 2);
  EXPECT_EQ(b.body.share({0, 0, 0}, diagonal_yz), 0.0);
}

TEST(CellBody, AGapOfOneCellHasNoSprings) {
  const CellBody b(solid({}, {5, 1, 1}, [](Vec3 p) { return !(2 < p.x && p.x < 3); }));
  EXPECT_EQ(b.body.particles, 24u);  // the gap removes no corners
  EXPECT_EQ(b.body.share({2, 0, 0}, {1, 0, 0, 0}), 0.0);
  for (const Neighbour& n : b.body.neighbours)
    for (const Range& range : b.body.springs_of(0, 0, n))
      EXPECT_FALSE(n.dx == 1 && range.begin <= 2 && 2 < range.end);
  EXPECT_EQ(b.area(box_between({2, 0, 0}, {2, 1, 1})),
            (Vec3{1, 0, 0}));  // the faces of the gap are opposite to each other
  EXPECT_EQ(b.area(box_between({3, 0, 0}, {3, 1, 1})), (Vec3{-1, 0, 0}));
}

TEST(CellRegions, FacesAreTheBodysOwn) {
  const CellBody b(box({3, 4, 5}));
  const std::tuple<const char*, std::size_t, Vec3> sides[] = {
      {"x_min", 30, {-20, 0, 0}}, {"x_max", 30, {20, 0, 0}},  {"y_min", 24, {0, -15, 0}},
      {"y_max", 24, {0, 15, 0}},  {"z_min", 20, {0, 0, -12}}, {"z_max", 20, {0, 0, 12}}};
  for (const auto& [name, particles, area] : sides) {
    EXPECT_EQ(b.count(named(name)), particles) << name;
    EXPECT_EQ(b.area(named(name)), area) << name;
  }
  EXPECT_EQ(b.count(named("surface")), b.body.particles - 2 * 3 * 4);
  EXPECT_EQ(b.count(named("inner_surface")), 0u);
  EXPECT_EQ(b.area(named("surface")), Vec3{});
}

TEST(CellRegions, SolidsHoldWhatTheyTouch) {
  const CellBody b(box({0.3, 0.4, 0.5}), 0.1);
  // In floating point, 3 * 0.1 is not 0.3.
  EXPECT_EQ(b.count(box_between({0, 0, 0}, {0.3, 0.2, 0.1})), 4u * 3 * 2);
  EXPECT_EQ(b.count(box_between({0.1, 0.1, 0.1}, {0.1 + 0.2, 0.3, 0.4})), 3u * 3 * 4);
  EXPECT_EQ(b.count(box_between({0.101, 0, 0}, {0.299, 0.4, 0.5})), 1u * 5 * 6);
  EXPECT_EQ(b.count(std::make_shared<Region>(ball(0, 0.1))),
            4u);  // the corner at the origin, and the three at distance 0.1
}

// A region contains a face fully or not at all. The areas of parts therefore add up to the whole
// surface.
TEST(CellRegions, PartsOfASurfaceAddUpToIt) {
  const CellBody b(box({3, 4, 5}));
  const Part half = box_between({0, 0, 0}, {3, 4, 2});
  EXPECT_EQ(b.area(make_set(Region::Kind::intersection, {named("x_max"), half})), (Vec3{8, 0, 0}));
  EXPECT_EQ(b.area(make_set(Region::Kind::difference, {named("x_max"), half})), (Vec3{12, 0, 0}));
  const Part other = box_between({0, 0, 2}, {3, 4, 5});
  EXPECT_EQ(b.area(make_set(Region::Kind::set_union, {named("x_max"), named("y_max")})),
            (Vec3{20, 15, 0}));
  EXPECT_EQ(b.area(make_set(Region::Kind::intersection, {named("x_max"), other})),
            (Vec3{12, 0, 0}));
}

TEST(CellRegions, InnerAndOuterSurfaceOfAHollowBall) {
  const CellBody b(ball(4, 9));
  const std::size_t inner = b.count(named("inner_surface")),
                    outer = b.count(named("outer_surface"));
  EXPECT_EQ(b.count(named("surface")), inner + outer);
  for (const Particle p : particles_in(b.body, b.surfaces, *named("inner_surface")))
    ASSERT_LT(norm(b.body.position(p)), 5);
  for (const Particle p : particles_in(b.body, b.surfaces, *named("outer_surface")))
    ASSERT_GT(norm(b.body.position(p)), 7);
}

}  // namespace cells_surfaces_test
