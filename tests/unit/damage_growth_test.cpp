// Principal values and the scalar equation of damage, against their definitions.
#include <state/damage_equations.hpp>
#include <state/damage_growth.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace damage_growth_test {
using namespace hyperlattice;

TEST(PrincipalValues, AreTheRootsOfTheCharacteristicPolynomial) {
  std::mt19937_64 random(5);
  const auto number = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
  for (int n = 0; n < 200; ++n) {
    const Symmetric s{number(), number(), number(), number(), number(), number()};
    const PrincipalStress of = principal_values(s);
    EXPECT_GE(of.first, of.second - 1e-14);
    EXPECT_GE(of.second, of.third - 1e-14);
    const double trace = s[0] + s[1] + s[2],
                 second = s[0] * s[1] + s[1] * s[2] + s[2] * s[0] - s[3] * s[3] - s[4] * s[4] -
                          s[5] * s[5],
                 third = s[0] * (s[1] * s[2] - s[3] * s[3]) - s[5] * (s[5] * s[2] - s[3] * s[4]) +
                         s[4] * (s[5] * s[3] - s[1] * s[4]);
    EXPECT_NEAR(of.first + of.second + of.third, trace, 1e-14);
    EXPECT_NEAR(of.first * of.second + of.second * of.third + of.third * of.first, second, 1e-13);
    EXPECT_NEAR(of.first * of.second * of.third, third, 1e-13);
  }
}

TEST(PrincipalValues, HoldForEqualOnesAndForZero) {
  const PrincipalStress zero = principal_values({}), equal = principal_values({3, 3, 3, 0, 0, 0}),
                        uniaxial = principal_values({0, 0, 7, 0, 0, 0}),
                        shear = principal_values({0, 0, 0, 0, 2, 0});
  EXPECT_EQ(zero.first, 0);
  EXPECT_EQ(equal.third, 3);
  EXPECT_NEAR(uniaxial.first, 7, 1e-14);
  EXPECT_NEAR(uniaxial.second, 0, 1e-7);
  EXPECT_NEAR(uniaxial.third, 0, 1e-7);
  EXPECT_NEAR(shear.first, 2, 1e-14);
  EXPECT_NEAR(shear.third, -2, 1e-14);
}

/// Left side of the equation at a rate.
double left_side(const DamageStep& of, double x) {
  const double left = 1 - of.damage - of.time_step * x,
               bottom = of.shape + (1 - of.shape) * left * left;
  return left / (bottom * bottom) * of.drive - left + of.spread -
         of.inertia * (x - of.rate) / of.time_step - of.viscosity * x;
}

TEST(DamageRate, SolvesItsEquationWithinItsBounds) {
  std::mt19937_64 random(6);
  const auto number = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  for (int n = 0; n < 2000; ++n) {
    DamageStep of;
    of.time_step = 1e-7;
    of.damage = n % 3 == 0 ? 0 : number();
    of.rate = n % 2 == 0 ? 0 : number() / of.time_step;
    of.shape = 0.75 + 5 * number() * number();
    of.drive = 4 * number();
    of.spread = number() - 0.5;
    of.inertia = (1 + 20 * number()) * of.time_step * of.time_step;
    of.viscosity = 10 * number() * of.time_step;
    const double x = damage_rate(of), most = (1 - of.damage) / of.time_step;
    EXPECT_GE(x, 0);
    EXPECT_LE(x, most);
    const double value = left_side(of, x);
    if (x == 0) {
      EXPECT_LE(value, 0);
    } else if (x == most) {
      EXPECT_GE(value, -1e-12);
    } else {
      EXPECT_NEAR(value, 0, 1e-11);
    }
  }
}

TEST(DamageRate, IsZeroBelowTheSurface) {
  DamageStep of;
  of.time_step = 1e-7;
  of.inertia = 1e-13;
  of.drive = 0.999;
  of.shape = 1;
  EXPECT_EQ(damage_rate(of), 0);
  of.drive = 1.001;
  EXPECT_GT(damage_rate(of), 0);
}

// With A below 1 damage has no stable value between 0 and 1 under a given strain, and 1 solves its
// equation under any. A search that has met it must find the surface all the same.
TEST(DamageEquations, FindTheSurfaceFromDamageThatIsComplete) {
  for (const double guess : {0.0, 1.0}) {
    std::vector<double> damage(3, guess);
    DamageEquations equations(damage);
    for (std::uint32_t n = 0; n < 3; ++n) {
      equations.add({n, 0, 0.8, 1.44});
      equations.add_other(n == 0 ? 1 : 0, 0.5);
    }
    EXPECT_NEAR(equations.solve({0, 2, 0.002}), 1 / 1.2, 1e-4) << guess;
  }
}

}  // namespace damage_growth_test
