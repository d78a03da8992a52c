// The strain of particles: exact for linear fields on any lattice, blind to rotations.
#include <state/particle_strain.hpp>
#include <support/cells.hpp>
#include <support/tensors.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace strain_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr double l = 1e-3;

/// R - I of a rotation by an angle about a direction (Rodrigues), without cancellation.
Tensor rotation_less_one(Vec3 direction, double angle) {
  const Vec3 n = direction / norm(direction);
  const Tensor K{{Vec3{0, -n.z, n.y}, Vec3{n.z, 0, -n.x}, Vec3{-n.y, n.x, 0}}};
  return std::sin(angle) * K + 2 * std::sin(angle / 2) * std::sin(angle / 2) * (K * K);
}

struct Moved {
  std::unique_ptr<Plan> plan;
  Simulation simulation;
  std::vector<Tensor> H;
  Moved(const std::string& scene, const Tensor& motion)
      : plan(plan_of(scene, 2)), simulation(*plan->model, 2) {
    simulation.set_displacements(linear(plan->model->body, motion), {});
    const PresentSprings springs(*plan->model, simulation);
    H = gradients(springs, springs.displacements());
  }
};

std::vector<std::string> lattices() {
  std::vector<std::string> all;
  const Keys none = {{"membrane", "none"}};
  for (const char* type : {"lattices.cubic", "lattices.bcc", "lattices.fcc", "lattices.random"})
    all.push_back(block(6, 6, 6, none, {}, type));
  all.push_back(block(6, 6, 1, none));
  for (const CellShape& shape : cell_shapes()) all.push_back(scene_of_cells(shape.shape, none));
  return all;
}

TEST(Strain, OfLinearFieldsIsExact) {
  const Tensor motion{{Vec3{0.1, 0.2, -0.3}, Vec3{0.05, -0.15, 0.1}, Vec3{0, 0.3, 0.2}}};
  for (const std::string& scene : lattices()) {
    const Moved body(scene, motion);
    std::uint64_t missing = 0;
    for (const Tensor& H : body.H) {
      if (std::isnan(H[0].x)) {
        ++missing;
        continue;
      }
      for (std::size_t i = 0; i < 3; ++i) ASSERT_LT(norm(H[i] - motion[i]), 1e-13) << scene;
    }
    // Only corners of random lattices, and plates of one particle, have too few springs.
    const bool thin = body.plan->model->body.grid.boundary == Boundary::particles &&
                      body.plan->model->body.is_cubic() &&
                      body.plan->model->body.low.k == body.plan->model->body.high.k;
    if (thin) {
      EXPECT_EQ(missing, body.H.size());
    } else {
      EXPECT_LT(missing, body.H.size() / 50 + 1) << scene;
    }
  }
}

TEST(Strain, OfARotationIsZero) {
  for (const std::string& scene : lattices())
    for (const double angle : {1e-9, 0.3, 2.5}) {
      const Moved body(scene, rotation_less_one({1, -2, 0.5}, angle));
      for (const Tensor& H : body.H) {
        if (std::isnan(H[0].x)) continue;
        ASSERT_LT(largest_component(green_lagrange_strain(H)), 1e-13 * std::max(angle, 1e-3));
        ASSERT_LT(largest_component(hencky_strain(H)), 1e-13);
      }
    }
}

TEST(Strain, HenckyHasTheLogarithmOfTheVolume) {
  const Tensor H{{Vec3{0.1, 0.2, -0.3}, Vec3{0.05, -0.15, 0.1}, Vec3{0, 0.3, 0.2}}};
  const Symmetric of = hencky_strain(H);
  EXPECT_NEAR(of[0] + of[1] + of[2], std::log1p(volume_change(H)), 1e-15);
  const Symmetric small =
      hencky_strain({{Vec3{1e-16, 2e-16, 0}, Vec3{0, -1e-16, 0}, Vec3{0, 0, 3e-16}}});
  EXPECT_NEAR(small[0] / 1e-16, 1, 1e-12);
  EXPECT_NEAR(small[5] / 1e-16, 1, 1e-12);
  const double stretch = 1.3;
  EXPECT_NEAR(hencky_strain({{Vec3{stretch - 1, 0, 0}, Vec3{}, Vec3{}}})[0], std::log(stretch),
              1e-15);
}

TEST(Strain, RateIsThatOfTheVelocitiesInSpace) {
  // F = R(t) U with a constant U: a rate of rotation only, in a strained body.
  const Tensor H{{Vec3{0.1, 0.2, -0.3}, Vec3{0.05, -0.15, 0.1}, Vec3{0, 0.3, 0.2}}};
  const Tensor spin{{Vec3{0, -7, 3}, Vec3{7, 0, 2}, Vec3{-3, -2, 0}}};
  EXPECT_LT(largest_component(strain_rate(H, spin * (identity + H))), 1e-14);
  const Tensor stretching{{Vec3{4, 1, 0}, Vec3{1, -2, 5}, Vec3{0, 5, 3}}};
  const Symmetric found = strain_rate(H, stretching * (identity + H)),
                  expected = symmetric_part(stretching);
  for (std::size_t n = 0; n < 6; ++n) EXPECT_NEAR(found[n], expected[n], 1e-13);
}

/// A crack leaves the strain of the springs that are there.
TEST(Strain, OfAParticleWithoutAWholeCellIsThatOfItsSprings) {
  const Keys weak = {{"poisson", 0.25},
                     {"failure", {{"type", "failures.elongation"}, {"limit", 2e-5}}}};
  const auto plan = plan_of(block(6, 6, 6, weak));
  const Body& body = plan->model->body;
  Simulation simulation(*plan->model, 1);
  const Tensor H{{Vec3{1e-3, 0, 0}, Vec3{0, 2e-3, 1e-3}, Vec3{0, 0, 1e-3}}};
  std::vector<double> u = linear(body, H);
  for (Particle p = 0; p < body.particles; ++p)
    if (body.position(p).z > 3e-3) u[3 * p + 2] += 0.05 * l;  // opens the middle plane
  simulation.set_displacements(u, {});
  simulation.step(1e-12);
  EXPECT_GT(simulation.broken(), 100u);
  const PresentSprings springs(*plan->model, simulation);
  std::uint64_t found = 0;
  for (const Tensor& of : gradients(springs, springs.displacements()))
    if (!std::isnan(of[0].x)) {
      ++found;
      for (std::size_t i = 0; i < 3; ++i) ASSERT_LT(norm(of[i] - H[i]), 1e-9);
    }
  EXPECT_EQ(found, body.particles);
}

}  // namespace strain_test
