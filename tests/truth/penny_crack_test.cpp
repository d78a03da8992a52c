// A penny-shaped crack under tension, as a cut of the lattice, against Sneddon's closed form.
#include <support/cuts.hpp>
#include <support/rest.hpp>

#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

namespace penny_crack_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

/// A penny-shaped crack of radius a under tension along z, at the middle of a cube of 8 a. A
/// quarter of it.
struct Penny {
  double opening = 0;  ///< at the centre, over 8 (1 - nu^2) sigma a / (pi E)
  double radius =
      0;  ///< that of the crack with the same volume of opening in an infinite body, over a
};

constexpr double young = 1, tension = 1e-7;

/// Mean displacement of the top less that of the bottom, m, and the opening at the centre, m.
std::array<double, 2> pulled(int cells, double poisson, bool is_cut) {
  const double a = cells, half = 4 * a;
  // The disc is half-way between two layers of particles.
  const Json crack = disc({0, 0, 0.5}, {0, 0, 1}, a);
  const AtRest rest(
      SceneBuilder{}
          .lattice("lattices.cubic", 1, box({0, 0, -half}, {half, half, half + 1}),
                   {{"boundary", "cells"}, {"cuts", is_cut ? Json::array({crack}) : Json::array()}})
          .material("materials.elastic", {{"young", young}, {"density", 1}, {"poisson", poisson}})
          .region("axis", box({-0.1, -0.1, -half - 0.1}, {0.1, 0.1, -half + 0.1}))
          .load("loads.fixed", {{"on", "x_min"}, {"axes", "x"}})
          .load("loads.fixed", {{"on", "y_min"}, {"axes", "y"}})
          .load("loads.fixed", {{"on", "axis"}, {"axes", "z"}})
          .load("loads.pressure", {{"on", "z_max"}, {"pressure", -tension}})
          .load("loads.pressure", {{"on", "z_min"}, {"pressure", -tension}})
          .stages(to_rest)
          .text());
  const Body& body = rest.model().body;
  double top = 0, bottom = 0;
  for (Particle p = 0; p < body.particles; ++p) {
    const double z = body.position(p).z, share = 2 * body.share(p) / (half * half);
    if (z > half + 0.9) top += share * rest.u[3 * p + 2];
    if (z < -half + 0.1) bottom += share * rest.u[3 * p + 2];
  }
  const auto at_centre = [&](int k) { return rest.u[3 * body.at({0, 0, body.low.k + k}) + 2]; };
  const int below = static_cast<int>(half);
  return {top - bottom, at_centre(below + 1) - at_centre(below)};
}

Penny penny(int cells, double poisson) {
  const auto cut = pulled(cells, poisson, true), whole = pulled(cells, poisson, false);
  const double a = cells, area = std::pow(4 * a, 2),
               per_unit = (1 - poisson * poisson) * tension / young;
  // By reciprocity, the volume of opening is the area of the ends times what the crack adds to the
  // elongation: 16 (1 - nu^2) sigma a^3 / (3 E), of which a quarter is here.
  const double volume = 4 * area * (cut[0] - whole[0]);
  return {cut[1] / (8 * per_unit * a / std::numbers::pi),
          std::cbrt(volume / (16 * per_unit / 3)) / a};
}

TEST(PennyCrack, OpensAsInTheClosedForm) {
  for (const double poisson : {0.25, 0.35}) {
    double last_opening = 1, last_radius = 1;
    for (const int cells : {3, 6}) {
      const Penny found = penny(cells, poisson);
      std::printf("nu %.2f, a = %d l: opening %.4f, radius %.4f\n", poisson, cells, found.opening,
                  found.radius);
      last_opening = std::abs(found.opening - 1);
      last_radius = std::abs(found.radius - 1);
      EXPECT_LT(last_radius, 0.5 / cells);
      EXPECT_LT(last_opening, 0.6 / cells);
    }
  }
}

}  // namespace penny_crack_test
