// Vec3: operators and components.
#include <hyperlattice/plain.hpp>

#include <gtest/gtest.h>

namespace vec3_test {
using namespace hyperlattice;

TEST(Vec3, Operators) {
  constexpr Vec3 a{1, -2, 4}, b{0.5, 3, -1};
  static_assert(a + b == Vec3{1.5, 1, 3});
  static_assert(a - b == Vec3{0.5, -5, 5});
  static_assert(-a == Vec3{-1, 2, -4});
  static_assert(2 * a == Vec3{2, -4, 8} && a * 2 == 2 * a);
  static_assert(a / 2 == Vec3{0.5, -1, 2});
  static_assert(dot(a, b) == -9.5);
  static_assert(cross(a, b) == Vec3{-10, 3, 4} && cross(b, a) == -cross(a, b));
  Vec3 sum = a;
  EXPECT_EQ(sum += b, a + b);
  EXPECT_EQ(sum -= b, a);
  EXPECT_EQ(sum *= 2, 2 * a);
  EXPECT_EQ(sum /= 4, a / 2);
  EXPECT_EQ(sum, a / 2);
  sum += sum;
  EXPECT_EQ(sum, a);
  EXPECT_EQ(norm({2, -3, 6}), 7);
}

TEST(Vec3, ComponentsByAxis) {
  constexpr Vec3 a{1, -2, 4};
  static_assert(a[0] == 1 && a[1] == -2 && a[2] == 4);
  Vec3 v;
  for (std::size_t axis = 0; axis < 3; ++axis) v[axis] = a[axis];
  EXPECT_EQ(v, a);
  for (int axis = 0; axis < 3; ++axis) v[axis] += 1;
  EXPECT_EQ(v, (Vec3{2, -1, 5}));
}

TEST(Vec3, DirectionsHaveLengthOneWhateverTheLengthOfTheVector) {
  for (const double length : {5e-324, 1e-200, 1e-3, 1.0, 7.0, 1e200, 1.7e308})
    EXPECT_EQ(direction_of({0, -length, 0}), (Vec3{0, -1, 0})) << length;
  for (const double length : {1e-300, 1e308}) {
    const Vec3 d = direction_of({length, length, length});
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(d[axis], 1 / std::sqrt(3.0), 1e-15) << length;
  }
  const Vec3 usual{0.3, -1.7, 4.1};
  EXPECT_EQ(direction_of(usual), usual / norm(usual)) << "no digit changes";
  EXPECT_EQ(scaled({}), Vec3{});
}
}  // namespace vec3_test
