// Convergence of bodies with flat faces: pure bending against St Venant's closed form, and a cube
// with glued ends against the finite element method. Poisson ratios up to 0.49 do not lock.
#include <support/loads_by_place.hpp>
#include <support/rest.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace convergence_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

/// Relative error of the compliance of a bar of 4 n x n x n cells in pure bending. The tractions
/// are linear over its ends. A cell gives its corners their part by the bilinear rule, and a whole
/// particle has the force on its own face.
double bending_error(int n, const std::string& boundary, double poisson) {
  constexpr double curvature = 1e-9;
  const double height = n, length = 4 * n;
  const auto corner = [](double x, double y) {
    return box({x - .75, y - .75, -.75}, {x + .75, y + .75, .75});
  };
  auto plan = plan_of(
      scene({{"spacing", 1}, {"shape", box({}, {length, height, height})}, {"boundary", boundary}},
            elastic(1, {{"poisson", poisson}}) + stage("loads.fixed", {{"on", corner(0, 0)}}) +
                stage("loads.fixed", {{"on", corner(length, 0)}, {"axes", "yz"}}) +
                stage("loads.fixed", {{"on", corner(0, height)}, {"axes", "z"}}) +
                stage("loads.force", {{"on", "x_min"}, {"each", {1, 0, 0}}, {"name", "near"}}) +
                stage("loads.force", {{"on", "x_max"}, {"each", {1, 0, 0}}, {"name", "far"}}) +
                stage("solvers.static", {{"tolerance", 1e-9}})));
  const auto traction = [&](double z) { return curvature * (z - height / 2); };
  const auto force = [&](Vec3 x) {
    if (boundary == "particles") return traction(x.z);
    double of_column = 0;
    for (const double next : {x.z - 1, x.z + 1})
      if (next > -0.5 && next < height + 0.5) of_column += (2 * traction(x.z) + traction(next)) / 6;
    const bool at_side = x.y < 0.5 || x.y > height - 0.5;
    return at_side ? of_column / 2 : of_column;
  };
  push(*plan, "near", [&](Vec3 x) { return Vec3{-force(x), 0, 0}; });
  push(*plan, "far", [&](Vec3 x) { return Vec3{force(x), 0, 0}; });
  const AtRest bar(std::move(plan));
  double work = 0;
  for (const char* end : {"near", "far"})
    for (const LoadedParticle& loaded : load_named(*bar.plan, end).particles)
      work += loaded.force.x * bar.u[3 * loaded.particle];
  const double inertia = std::pow(height, 4) / 12;  // E = 1
  return work / (curvature * curvature * inertia * length) - 1;
}

struct Bending {
  double poisson, error[4];  ///< of the prototype with n = 1, 2, 4, 8
};
const Bending bending[] = {{0.25, {-.444, -.181, -.0544, -.0144}},
                           {0.4, {-.378, -.134, -.0375, -.0097}},
                           {0.45, {-.356, -.122, -.0335, -.0086}},
                           {0.49, {-.338, -.113, -.0308, -.0079}}};

TEST(PureBending, ConvergesAsThePrototype) {
  for (const Bending& of : bending)
    for (int n = 0; n < 3; ++n)
      EXPECT_NEAR(bending_error(1 << n, "cells", of.poisson), of.error[n], 1e-3)
          << of.poisson << ", " << (1 << n);
}

/// Prints the table of docs/theory/convergence.md.
TEST(LongPureBending, TableOfAllBoundaries) {
  for (const char* boundary : {"particles", "cells"})
    for (const Bending& of : bending) {
      std::printf("%s %.2f:", boundary, of.poisson);
      double found[4];
      for (int n = 0; n < 4; ++n) {
        found[n] = bending_error(1 << n, boundary, of.poisson);
        std::printf(" %.4f", found[n]);
        if (std::string(boundary) == "cells") {
          EXPECT_NEAR(found[n], of.error[n], 1e-3) << of.poisson << ", " << (1 << n);
        }
      }
      std::printf(", order %.2f\n", std::log2(found[2] / found[3]));
    }
}

/// A cube of `cells` cells along its edges, glued to platens that are moved towards each other.
struct Glued {
  double modulus = 0;  ///< apparent E over E
  std::uint64_t iterations = 0;
};
Glued glue(int cells, const std::string& boundary, double poisson, double tolerance) {
  constexpr double strain = 1e-10;
  const double size = cells;
  const AtRest cube(
      scene({{"spacing", 1}, {"shape", box({}, {size, size, size})}, {"boundary", boundary}},
            elastic(1, {{"poisson", poisson}}) + stage("loads.fixed", {{"on", "z_min"}}) +
                stage("loads.displacement",
                      {{"on", "z_max"}, {"value", {0, 0, -strain * size}}, {"rise", 1e-9}}) +
                stage("solvers.static", {{"tolerance", tolerance}})));
  return {cube.simulation->force_on_load().at(1).z / (size * size) / strain,
          cube.report.iterations};
}

/// The prototype's numbers for 4, 8, 16 and 32 cells. They tend to the last one, of finite elements
/// (CalculiX, C3D20R, extrapolated).
struct GluedCube {
  double poisson, modulus[4], limit;
};
const GluedCube glued_cubes[] = {{0.25, {1.06458, 1.05096, 1.04579, 1.04381}, 1.0426},
                                 {0.45, {1.27707, 1.21290, 1.18903, 1.17950}, 1.1726},
                                 {0.49, {1.35997, 1.27404, 1.24213, 1.22923}, 1.2196}};

TEST(GluedCube, DoesNotLock) {
  for (const GluedCube& of : glued_cubes)
    for (int n = 0; n < 3; ++n)
      EXPECT_NEAR(glue(4 << n, "cells", of.poisson, 1e-9).modulus, of.modulus[n], 1e-4)
          << of.poisson << ", " << (4 << n);
}

TEST(LongGluedCube, DoesNotLock) {
  for (const GluedCube& of : glued_cubes)
    EXPECT_NEAR(glue(32, "cells", of.poisson, 1e-8).modulus, of.modulus[3], 1e-4) << of.poisson;
}

/// Prints the table of docs/theory/convergence.md.
TEST(LongGluedCube, TableOfAllBoundaries) {
  for (const char* boundary : {"particles", "cells"})
    for (const double poisson : {0.25, 0.4, 0.45, 0.49}) {
      std::printf("%s %.2f:", boundary, poisson);
      double found[4];
      for (int n = 0; n < 4; ++n) {
        found[n] = glue(4 << n, boundary, poisson, 1e-8).modulus;
        std::printf(" %.5f", found[n]);
      }
      std::printf(", order %.2f\n", std::log2((found[1] - found[2]) / (found[2] - found[3])));
      std::fflush(stdout);
    }
}

/// Iterations of conjugate gradients to a residual of 1e-6 with 16^3 cells.
TEST(GluedCube, TakesFewIterations) {
  for (const auto& [poisson, most] : {std::pair{0.25, 8U}, {0.4, 10U}, {0.45, 12U}, {0.49, 20U}}) {
    const std::uint64_t iterations = glue(16, "cells", poisson, 1e-6).iterations;
    std::printf("nu %.2f: %u iterations\n", poisson, static_cast<unsigned>(iterations));
    EXPECT_LE(iterations, most) << poisson;
  }
}

}  // namespace convergence_test
