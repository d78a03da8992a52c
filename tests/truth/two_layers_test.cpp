// The model of the paper has two layers: the body, and its parallel copy in the fourth dimension.
// The mirrored single layer must be equivalent. The test computes both layers from positions, and
// compares them with the single layer over a violent undamped motion.
#include <support/scenes.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace two_layers_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

using Point = std::array<double, 4>;

struct Spring {
  std::size_t a, b;
  double stiffness, rest;
};

/// Both layers of a body, equations (6) to (9) of the paper in four dimensions.
struct TwoLayers {
  std::vector<Point> place, velocity;
  std::vector<Spring> springs;
  double mass;

  static double length(const Point& a, const Point& b) {
    double sum = 0;
    for (std::size_t c = 0; c < 4; ++c) sum += (b[c] - a[c]) * (b[c] - a[c]);
    return std::sqrt(sum);
  }

  explicit TwoLayers(const Model& model) : mass(model.materials[0].mass) {
    const MaterialConstants& constants = model.materials[0].constants;
    const double delta = model.body.grid.membrane_distance, l = model.body.grid.spacing,
                 k = constants.base_stiffness;
    const std::size_t n = model.body.particles;
    for (const double w : {0.0, delta})
      for (Particle p = 0; p < n; ++p) {
        const Vec3 x = model.body.position(p);
        place.push_back({x.x, x.y, x.z, w});
      }
    velocity.resize(2 * n);
    for (std::size_t a = 0; a < n; ++a) {
      springs.push_back({a, a + n, constants.alpha_ratio * k, delta});
      for (std::size_t b = a + 1; b < n; ++b) {
        const double rest = length(place[a], place[b]);
        if (rest > 1.5 * l) continue;
        const double cross = k * constants.cross_ratio[rest > 1.2 * l ? 1 : 0],
                     cross_rest = length(place[a], place[b + n]);
        springs.push_back({a, b, k, rest});
        springs.push_back({a + n, b + n, k, rest});
        springs.push_back({a, b + n, cross, cross_rest});
        springs.push_back({a + n, b, cross, cross_rest});
      }
    }
  }

  /// v += kick a, x += drift v.
  void step(double kick, double drift) {
    std::vector<Point> force(place.size(), Point{});
    for (const Spring& s : springs) {
      const double now = length(place[s.a], place[s.b]), pull = s.stiffness * (now - s.rest) / now;
      for (std::size_t c = 0; c < 4; ++c) {
        const double f = pull * (place[s.b][c] - place[s.a][c]);
        force[s.a][c] += f;
        force[s.b][c] -= f;
      }
    }
    for (std::size_t p = 0; p < place.size(); ++p)
      for (std::size_t c = 0; c < 4; ++c) {
        velocity[p][c] += kick * force[p][c] / mass;
        place[p][c] += drift * velocity[p][c];
      }
  }
};

class MovingMembrane : public testing::TestWithParam<MembraneCase> {};
INSTANTIATE_TEST_SUITE_P(Membranes, MovingMembrane,
                         testing::Values(membrane_cases[1], membrane_cases[2], membrane_cases[6],
                                         membrane_cases[8]),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_P(MovingMembrane, OneMirroredLayerMovesAsTwoLayersDo) {
  const auto plan = plan_of(block(5, 5, 5, GetParam().material));
  const Model& model = *plan->model;
  ASSERT_EQ(model.degrees_of_freedom, 4);
  const std::size_t n = model.body.particles;
  TwoLayers layers(model);
  Simulation mirrored(model, 2);

  auto u = noise(3 * n, 0.05e-3, 3);
  for (Particle p = 0; p < n; ++p) {  // 20 % stretch, and shear
    u[3 * p] += 0.2 * model.body.position(p).x;
    u[3 * p + 1] += 0.1 * model.body.position(p).x;
  }
  // The height over the mirror plane is Delta/2 - w for the body (w = 0 at rest) and w - Delta/2
  // for its copy (w = Delta at rest).
  const auto heights = noise(n, 0.05e-3, 4);
  for (std::size_t p = 0; p < n; ++p)
    for (const std::size_t layer : {p, p + n}) {
      for (std::size_t c = 0; c < 3; ++c) layers.place[layer][c] += u[3 * p + c];
      layers.place[layer][3] += layer == p ? -heights[p] : heights[p];
    }
  mirrored.set_displacements(u, heights);

  const double step = 0.2 * model.step_limit.time_step;
  for (int s = 0; s < 500; ++s) {
    layers.step(s == 0 ? step / 2 : step, step);
    mirrored.step(step);
  }
  const auto found = displacements(mirrored);
  std::vector<double> risen;
  mirrored.heights(risen);
  double worst = 0;
  for (std::size_t p = 0; p < n; ++p) {
    const Vec3 x = model.body.position(p);
    const double expected[3] = {layers.place[p][0] - x.x, layers.place[p][1] - x.y,
                                layers.place[p][2] - x.z};
    for (std::size_t c = 0; c < 3; ++c)
      worst = std::max(worst, std::abs(found[3 * p + c] - expected[c]));
    worst = std::max(worst, std::abs(risen[p] + layers.place[p][3]));
  }
  EXPECT_LT(worst, 1e-10 * 1e-3)
      << "round-off grows in a chaotic motion, but not further in 500 steps of a lattice of 1 mm";
}

}  // namespace two_layers_test
