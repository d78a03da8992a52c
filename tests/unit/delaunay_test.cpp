// The Delaunay triangulation: no point in a sphere, the volume of the hull, points on one sphere.
#include <geometry/delaunay.hpp>
#include <support/scenes.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace delaunay_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

std::vector<Vec3> random_points(std::size_t count, unsigned seed) {
  const std::vector<double> x = noise(3 * count, 1, seed);
  std::vector<Vec3> points;
  points.reserve(count);
  for (std::size_t p = 0; p < count; ++p) points.push_back({x[3 * p], x[3 * p + 1], x[3 * p + 2]});
  return points;
}

double volume_of(const std::vector<Tetrahedron>& all, const std::vector<Vec3>& points) {
  double volume = 0;
  for (const Tetrahedron& of : all) {
    const Vec3 a = points[of.corners[0]];
    volume += dot(points[of.corners[1]] - a,
                  cross(points[of.corners[2]] - a, points[of.corners[3]] - a)) /
              6;
  }
  return volume;
}

/// Centre of the sphere through the corners.
Vec3 centre_of(const Tetrahedron& of, const std::vector<Vec3>& points) {
  const Vec3 o = points[of.corners[0]], a = points[of.corners[1]] - o,
             b = points[of.corners[2]] - o, c = points[of.corners[3]] - o;
  return o + (dot(a, a) * cross(b, c) + dot(b, b) * cross(c, a) + dot(c, c) * cross(a, b)) /
                 (2 * dot(a, cross(b, c)));
}

TEST(Delaunay, SpheresHoldNoOtherPoint) {
  const std::vector<Vec3> points = random_points(300, 3);
  const std::vector<Tetrahedron> all = delaunay(points);
  ASSERT_GT(all.size(), 1500U);
  for (const Tetrahedron& of : all) {
    const Vec3 centre = centre_of(of, points);
    const double radius = norm(points[of.corners[0]] - centre);
    for (const Vec3 x : points) ASSERT_GE(norm(x - centre), radius * (1 - 1e-6));
  }
}

TEST(Delaunay, NeighboursHaveAFaceInCommon) {
  const std::vector<Tetrahedron> all = delaunay(random_points(500, 4));
  for (std::uint32_t t = 0; t < all.size(); ++t)
    for (std::size_t n = 0; n < 4; ++n) {
      const std::uint32_t next = all[t].neighbours[n];
      if (next == no_tetrahedron) continue;
      std::size_t common = 0;
      for (const std::uint32_t corner : all[t].corners)
        for (const std::uint32_t other : all[next].corners) common += corner == other ? 1 : 0;
      ASSERT_EQ(common, 3U);
      const auto& back = all[next].neighbours;
      ASSERT_NE(std::find(back.begin(), back.end(), t), back.end());
    }
}

/// All points of a cubic block are on spheres of eight.
TEST(Delaunay, FillsABlockWhosePointsAreOnCommonSpheres) {
  std::vector<Vec3> points;
  for (int k = 0; k < 7; ++k)
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 5; ++i) points.push_back({0.1 * i, 0.1 * j, 0.1 * k});
  EXPECT_NEAR(volume_of(delaunay(points), points), 0.4 * 0.5 * 0.6, 1e-12);
}

TEST(Delaunay, TakesPointsWithoutVolume) {
  EXPECT_TRUE(delaunay({}).empty());
  EXPECT_TRUE(delaunay(std::vector<Vec3>(1)).empty());
  std::vector<Vec3> flat = random_points(40, 5);
  for (Vec3& x : flat) x.z = 1;
  EXPECT_NEAR(volume_of(delaunay(flat), flat), 0, 1e-15);
  std::vector<Vec3> twice = random_points(30, 6);
  twice.insert(twice.end(), twice.begin(), twice.end());
  EXPECT_GT(volume_of(delaunay(twice), twice), 1);
}

}  // namespace delaunay_test
