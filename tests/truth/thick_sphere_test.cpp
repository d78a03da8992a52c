// A thick sphere under pressure from inside, against Lame's closed form: displacement, and stress
// away from the surfaces, for every boundary of a body and Poisson ratios up to 0.49.
#include <state/particle_stress.hpp>
#include <support/rest.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace thick_sphere_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr double inner = 20, outer = 50, pressed = 1e-7, young = 1;

/// Errors against Lame: of the displacement relative in L2, counted by the shares of the particles;
/// of stresses root mean squares over the particles farther than two spacings from both surfaces,
/// over the pressure.
struct Errors {
  double displacement = 0, radial = 0, hoop = 0, pressure = 0;
};

/// One octant with its planes of symmetry. Whole particles have no plane of symmetry on their own
/// half cells, so their sphere is whole and free.
std::string sphere_scene(double spacing, const std::string& boundary, double poisson) {
  const Json shell = {{"hollow_sphere", {{"inner_radius", inner}, {"outer_radius", outer}}}};
  const Json octant = {{"intersection", {shell, box({0, 0, 0}, {60, 60, 60})}}};
  const bool whole = boundary == "particles";
  SceneBuilder scene;
  scene.lattice("lattices.cubic", spacing, whole ? shell : octant, {{"boundary", boundary}})
      .material("materials.elastic", {{"young", young}, {"density", 1}, {"poisson", poisson}})
      .region("wall", {{"sphere", {{"radius", 35}}}})
      .load("loads.pressure",
            {{"on", {{"intersection", {"surface", "wall"}}}}, {"pressure", pressed}});
  for (const char* axis : {"x", "y", "z"})
    if (!whole) scene.load("loads.fixed", {{"on", std::string(axis) + "_min"}, {"axes", axis}});
  return scene.stages(to_rest).text();
}

Errors errors(double spacing, const std::string& boundary, double poisson) {
  const AtRest sphere(sphere_scene(spacing, boundary, poisson));
  const Body& body = sphere.model().body;
  const auto stress = cauchy_stresses(PresentSprings(sphere.model(), *sphere.simulation));
  const double a3 = std::pow(inner, 3), b3 = std::pow(outer, 3), q = pressed * a3 / (b3 - a3);
  Errors sum;
  double size = 0, counted = 0;
  for (Particle n = 0; n < body.particles; ++n) {
    const Vec3 x = body.position(n);
    const double r = norm(x), r3 = r * r * r;
    if (r < inner || r > outer) continue;
    const double u = q / young * ((1 - 2 * poisson) * r + (1 + poisson) * b3 / (2 * r * r)),
                 found = dot(x, {sphere.u[3 * n], sphere.u[3 * n + 1], sphere.u[3 * n + 2]}) / r;
    sum.displacement += body.share(n) * (found - u) * (found - u);
    size += body.share(n) * u * u;
    if (r < inner + 2 * spacing || r > outer - 2 * spacing) continue;
    const Symmetric& s = stress[n];
    const Vec3 e = x / r,
               pull{s[0] * e.x + s[5] * e.y + s[4] * e.z, s[5] * e.x + s[1] * e.y + s[3] * e.z,
                    s[4] * e.x + s[3] * e.y + s[2] * e.z};
    const double radial = dot(e, pull), hoop = (s[0] + s[1] + s[2] - radial) / 2;
    sum.radial += std::pow(radial - q * (1 - b3 / r3), 2);
    sum.hoop += std::pow(hoop - q * (1 + b3 / (2 * r3)), 2);
    sum.pressure += std::pow(pressure(s) + q, 2);
    ++counted;
  }
  const auto mean = [&](double of) { return std::sqrt(of / counted) / pressed; };
  return {std::sqrt(sum.displacement / size), mean(sum.radial), mean(sum.hoop), mean(sum.pressure)};
}

/// Errors at the spacings 5, 2.5 and 1.25. Displacements are those of an independent prototype. Of
/// stresses a bound is given, a little above what is found.
struct Expected {
  const char* boundary;
  double poisson;
  double displacement[3], radial[3], hoop[3], pressure[3];
};
const Expected expected[] = {{"cells",
                              0.25,
                              {.0636, .0361, .0179},
                              {.0085, .0073, .0048},
                              {.0140, .0072, .0037},
                              {.0077, .0040, .0023}},
                             {"cells",
                              0.45,
                              {.0653, .0393, .0198},
                              {.0087, .0082, .0055},
                              {.0167, .0085, .0045},
                              {.0106, .0049, .0029}},
                             {"cells",
                              0.49,
                              {.0650, .0394, .0199},
                              {.0091, .0084, .0056},
                              {.0177, .0087, .0046},
                              {.0120, .0052, .0031}},
                             {"partial_cells",
                              0.25,
                              {.0435, .0080, .0017},
                              {.0082, .0021, .0012},
                              {.0077, .0020, .0006},
                              {.0041, .0011, .0005}},
                             {"partial_cells",
                              0.49,
                              {.0925, .0166, .0028},
                              {.0167, .0039, .0014},
                              {.0156, .0036, .0009},
                              {.0079, .0022, .0008}}};

void compare(const Expected& of, int refined) {
  const double spacing = 5 / std::pow(2, refined);
  const Errors found = errors(spacing, of.boundary, of.poisson);
  const std::string what = std::string(of.boundary) + ", nu " + std::to_string(of.poisson) +
                           ", spacing " + std::to_string(spacing);
  // Bodies of few cells differ in how much a particle at the surface counts, partial cells in their
  // shares.
  const double digits = std::string(of.boundary) != "cells" ? 0.1 : refined == 0 ? 0.06 : 0.02;
  EXPECT_NEAR(found.displacement / of.displacement[refined], 1, digits) << what;
  for (const auto& [stress, most] : {std::pair{found.radial, of.radial[refined]},
                                     {found.hoop, of.hoop[refined]},
                                     {found.pressure, of.pressure[refined]}})
    EXPECT_LT(stress, most) << what;
}

TEST(ThickSphere, HasTheErrorsOfThePrototype) {
  for (const Expected& of : expected)
    for (const int refined : {0, 1}) compare(of, refined);
}

TEST(ThickSphere, OfPartialCellsConvergesWithSecondOrder) {
  for (const double poisson : {0.25, 0.45})
    EXPECT_GT(std::log2(errors(5, "partial_cells", poisson).displacement /
                        errors(2.5, "partial_cells", poisson).displacement),
              1.8)
        << poisson;
}

TEST(LongThickSphere, HasTheErrorsOfThePrototype) {
  for (const Expected& of : expected) compare(of, 2);
}

/// Prints the table of docs/theory/convergence.md.
void print(const char* boundary, double poisson, double least_order) {
  Errors found[3];
  for (int n = 0; n < 3; ++n) found[n] = errors(5 / std::pow(2, n), boundary, poisson);
  const double order = std::log2(found[1].displacement / found[2].displacement);
  std::printf("%s, nu %.2f, u:", boundary, poisson);
  for (const Errors& of : found) std::printf(" %.4f", of.displacement);
  std::printf(", order %.2f; radial, hoop, pressure:", order);
  for (const Errors& of : found) std::printf(" %.4f %.4f %.4f;", of.radial, of.hoop, of.pressure);
  std::printf("\n");
  std::fflush(stdout);
  EXPECT_GT(order, least_order) << boundary << ", " << poisson;
}

TEST(LongThickSphere, TableOfCells) {
  for (const double poisson : {0.25, 0.4, 0.45, 0.49}) print("cells", poisson, 0.9);
}
TEST(LongThickSphere, TableOfPartialCells) {
  for (const double poisson : {0.25, 0.4, 0.45, 0.49}) print("partial_cells", poisson, 1.8);
}
TEST(LongThickSphere, TableOfParticles) {
  for (const double poisson : {0.25, 0.4, 0.45, 0.49}) print("particles", poisson, 0.9);
}

}  // namespace thick_sphere_test
