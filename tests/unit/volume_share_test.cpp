// The volume of solids in cubes: exact for flat surfaces, to 1e-4 of a cube for round ones.
#include <geometry/triangle_mesh.hpp>
#include <geometry/volume_share.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace volume_share_test {
using namespace hyperlattice;

constexpr double pi = std::numbers::pi;
using Part = std::shared_ptr<const Region>;

/// The common inner side of some surfaces.
Part common_side(const std::vector<SolidSurface>& surfaces) {
  auto region = std::make_shared<Region>();
  region->kind = Region::Kind::solid;
  region->surfaces = surfaces;
  region->inside = [surfaces](Vec3 p) {
    return std::all_of(surfaces.begin(), surfaces.end(),
                       [p](const SolidSurface& s) { return s.height(p) <= 0; });
  };
  return region;
}
Part ball(Vec3 centre, double radius) { return common_side({{centre, {}, radius}}); }
Part half_space(Vec3 point, Vec3 normal) { return common_side({{point, normal / norm(normal)}}); }
Part box(Vec3 low, Vec3 high) {
  return common_side({{low, {-1, 0, 0}},
                      {high, {1, 0, 0}},
                      {low, {0, -1, 0}},
                      {high, {0, 1, 0}},
                      {low, {0, 0, -1}},
                      {high, {0, 0, 1}}});
}
Part cylinder(Vec3 start, Vec3 axis, double radius, double length) {
  const Vec3 d = axis / norm(axis);
  return common_side({{start, d, radius}, {start, -d}, {start + length * d, d}});
}

/// A box of facets, anticlockwise seen from outside.
Part mesh_box(Vec3 low, Vec3 high) {
  TriangleMesh mesh;
  for (unsigned n = 0; n < 8; ++n)
    mesh.points.push_back({(n & 1U) != 0 ? high.x : low.x, (n & 2U) != 0 ? high.y : low.y,
                           (n & 4U) != 0 ? high.z : low.z});
  constexpr std::uint32_t sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& s : sides) {
    mesh.facets.push_back({s[0], s[1], s[2]});
    mesh.facets.push_back({s[0], s[2], s[3]});
  }
  const auto inside = std::make_shared<const InsideTest>(std::move(mesh));
  auto region = std::make_shared<Region>();
  region->kind = Region::Kind::solid;
  region->facets = inside;
  region->inside = [inside](Vec3 p) { return (*inside)(p); };
  return region;
}

/// Sum over unit cubes between -size and size.
double volume(const Region& solid, int size) {
  double sum = 0;
  for (int k = -size; k < size; ++k)
    for (int j = -size; j < size; ++j)
      for (int i = -size; i < size; ++i)
        sum += volume_share(solid, {{1.0 * i, 1.0 * j, 1.0 * k}, 1});
  return sum;
}

TEST(VolumeShare, OfOnePlaneIsExact) {
  // The plane x + y + z = 1 cuts off a sixth, and x + y = 1 halves the cube.
  const Cube cube{{0, 0, 0}, 1};
  EXPECT_NEAR(volume_share(*half_space({1, 0, 0}, {1, 1, 1}), cube), 1.0 / 6, 1e-15);
  EXPECT_NEAR(volume_share(*half_space({1, 0, 0}, {-1, -1, -1}), cube), 5.0 / 6, 1e-15);
  EXPECT_NEAR(volume_share(*half_space({1, 0, 0}, {1, 1, 0}), cube), 0.5, 1e-15);
  EXPECT_EQ(volume_share(*half_space({1, 0, 0}, {1, 0, 0}), cube), 1);  // it touches a face
  EXPECT_EQ(volume_share(*half_space({0, 0, 0}, {1, 0, 0}), cube), 0);
}

TEST(VolumeShare, OfABallIsRightInEachCube) {
  // The cube at a pole: its part of the ball is a cap.
  const Part big = ball({0.5, 0.5, -19.7}, 20);
  const double reference = [] {  // by Simpson's rule on a grid of heights
    constexpr int n = 2000;
    double sum = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const double x = (i + 0.5) / n - 0.5, y = (j + 0.5) / n - 0.5;
        sum += std::clamp(std::sqrt(400 - x * x - y * y) - 19.7, 0.0, 1.0);
      }
    return sum / n / n;
  }();
  EXPECT_NEAR(volume_share(*big, {{0, 0, 0}, 1}), reference, 2e-6);
  for (const double radius : {0.3, 0.7, 1.5, 4.0, 8.0})
    EXPECT_NEAR(volume(*ball({0.13, 0.21, -0.32}, radius), static_cast<int>(radius) + 2) /
                    (4 * pi / 3 * radius * radius * radius),
                1, 1e-6)
        << radius;
}

TEST(VolumeShare, OfACylinderInAnyDirection) {
  for (const Vec3 axis : {Vec3{0, 0, 1}, Vec3{1, 2, 3}, Vec3{0, 1, 1}})
    EXPECT_NEAR(volume(*cylinder({-1, -2, -3}, axis, 3, 5), 8) / (pi * 9 * 5), 1, 1e-5);
}

TEST(VolumeShare, OfSetsOfFlatSolidsIsExact) {
  using Kind = Region::Kind;
  const Part left = box({-3.3, -2.7, -4.1}, {0.45, 3.4, 1.9}),
             right = box({0.45, -2.7, -4.1}, {2.2, 3.4, 1.9});
  // Parts with a common face.
  EXPECT_NEAR(volume(*make_set(Kind::set_union, {left, right}), 5), 5.5 * 6.1 * 6, 1e-12);
  EXPECT_NEAR(volume(*make_set(Kind::difference, {left, right}), 5), 3.75 * 6.1 * 6, 1e-12);
  // A rotated box.
  const Vec3 a = Vec3{1, 0.3, 0.2} / norm(Vec3{1, 0.3, 0.2}),
             b = cross(a, Vec3{0, 0, 1}) / norm(cross(a, Vec3{0, 0, 1})), c = cross(a, b);
  std::vector<Part> sides;
  for (const double side : {-1.0, 1.0}) {
    sides.push_back(half_space(2.0 * side * a, side * a));
    sides.push_back(half_space(1.5 * side * b, side * b));
    sides.push_back(half_space(3.0 * side * c, side * c));
  }
  EXPECT_NEAR(volume(*make_set(Kind::intersection, sides), 6), 4.0 * 3 * 6, 1e-11);
}

TEST(VolumeShare, OfSetsOfRoundSolids) {
  using Kind = Region::Kind;
  const Part block = box({-5.3, -5.3, -5.3}, {5.3, 5.3, 5.3});
  EXPECT_NEAR(volume(*make_set(Kind::difference, {block, ball({5.3, 5.3, 5.3}, 4)}), 6) /
                  (std::pow(10.6, 3) - pi / 6 * 64),
              1, 1e-6);
  // Two balls of radius 5, their centres 3 apart.
  EXPECT_NEAR(volume(*make_set(Kind::set_union, {ball({}, 5), ball({3, 0, 0}, 5)}), 9) /
                  (8 * pi / 3 * 125 - pi * 23 * 49 / 12),
              1, 2e-6);
}

TEST(VolumeShare, OfAMeshIsExact) {
  using Kind = Region::Kind;
  const Vec3 low{-3, -2, -4}, high{2.3, 3.4, 1};
  const Part mesh = mesh_box(low, high);
  EXPECT_NEAR(volume(*mesh, 5), 5.3 * 5.4 * 5, 1e-11);
  EXPECT_EQ(volume_share(*mesh, {{-3, -2, -4}, 1}), 1);  // faces of the cube on the mesh
  EXPECT_EQ(volume_share(*mesh, {{-4, -2, -4}, 1}), 0);
  EXPECT_NEAR(volume(*make_set(Kind::intersection, {mesh, box(low, high)}), 5), 5.3 * 5.4 * 5,
              1e-11);
  EXPECT_NEAR(
      volume(*make_set(Kind::difference, {mesh, ball(high, 2)}), 5) / (5.3 * 5.4 * 5 - pi / 6 * 8),
      1, 2e-6);
}

TEST(VolumeShare, OfASolidThatIsKnownByPointsOnly) {
  Region solid;
  solid.kind = Region::Kind::solid;
  solid.inside = [](Vec3 p) { return norm(p) <= 1; };
  EXPECT_NEAR(volume_share(solid, {{0, 0, 0}, 1}), pi / 6, 2e-3);
}

}  // namespace volume_share_test
