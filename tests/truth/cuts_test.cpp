// Bodies with cuts: a cut through everything against the halves alone, bodies that fly apart
// without a force, and a penny-shaped crack under tension against Sneddon's closed form.
#include <model/body_figures.hpp>
#include <support/cuts.hpp>
#include <support/rest.hpp>
#include <support/scenes.hpp>

#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

namespace {
using namespace hyperlattice;
using namespace hyperlattice::test;

/// Steps a scene and returns the displacements by the sites' positions.
struct Moved {
  std::unique_ptr<Plan> plan;
  std::unique_ptr<Simulation> simulation;

  explicit Moved(const std::string& scene, int steps, int threads = 1)
      : plan(plan_of(scene, threads)),
        simulation(std::make_unique<Simulation>(*plan->model, threads)) {
    for (int n = 0; n < steps; ++n) simulation->step(0.5 * plan->model->step_limit.time_step);
  }
  const Body& body() const { return plan->model->body; }
};

/// A bar along x under opposite forces, cut at x = 8 mm, against the part below 8 mm alone. Its
/// displacements have the same bits, as no spring acts between the parts.
TEST(Cuts, PartsMoveAsIfTheyWereAlone) {
  for (const MembraneCase& of : {membranes[0], membranes[6], volumetric[0]}) {
    const auto scene = [&](const Json& shape, const Json& cuts, const char* more) {
      return SceneBuilder{}
          .lattice("lattices.cubic", 1e-3, shape, {{"cuts", cuts}})
          .material("materials.elastic", of.material + Keys{{"young", 1e10}, {"density", 2500}})
          .load("loads.force", {{"on", "x_min"}, {"each", {-3e-2, 1e-2, 0}}})
          .stages(more)
          .solver("solvers.explicit", {{"end_time", 1e-3}})
          .text();
    };
    const Moved cut(scene(box_mm(15, 5, 4), Json::array({plane({8e-3, 0, 0}, {1, 0, 0})}),
                          R"({"type": "loads.force", "on": "x_max", "each": [5e-2, 0, 2e-2]})"),
                    200),
        alone(scene(box_mm(8, 5, 4), Json::array(), ""), 200);
    EXPECT_EQ(parts_of(cut.body()).count, 2U);
    const auto u = displacements(*cut.simulation), v = displacements(*alone.simulation);
    EXPECT_GT(largest(v), 0);
    for (Particle p = 0; p < alone.body().particles; ++p) {
      const Particle same = cut.body().at(alone.body().site(p));
      for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(u[3 * same + c], v[3 * p + c]) << of.name;
    }
    EXPECT_EQ(cut.simulation->broken(), 0U);
  }
}

struct Lattice {
  const char* type;
  Keys more;
  Keys material;
};
const Lattice lattices[] = {
    {"lattices.cubic", {}, {{"poisson", 0.25}}},
    {"lattices.cubic", {}, {{"poisson", 0.35}}},
    {"lattices.cubic", {}, {{"membrane", "I-m"}, {"poisson", 0.1}}},
    {"lattices.cubic", {{"boundary", "cells"}}, {{"poisson", 0.3}}},
    {"lattices.cubic",
     {{"boundary", "partial_cells"}, {"anchor", {3e-4, 2e-4, 4e-4}}},
     {{"poisson", 0.3}}},
    {"lattices.bcc", {}, {{"poisson", 0.25}}},
    {"lattices.fcc", {}, {{"poisson", 0.25}}},
    {"lattices.random", {}, {}},
    {"lattices.random", {}, {{"poisson", 0.35}}},
};

/// A tilted plane through particles, or past them, cuts a block in two. The parts are thrown
/// sideways: they keep their velocities, since nothing holds them together.
TEST(Cuts, PartsFlyApartWithoutForce) {
  const Vec3 point{5e-3, 4.5e-3, 4.5e-3}, normal{1, 1, 0}, velocity{0.3, -0.2, 0.4};
  for (const Lattice& of : lattices)
    for (const int threads : {1, 3}) {
      const Moved thrown(
          SceneBuilder{}
              .stage(of.type, Keys{{"spacing", 1e-3},
                                   {"shape", box_mm(10, 9, 8)},
                                   {"cuts", Json::array({plane(point, normal)})}} +
                                  of.more)
              .material("materials.elastic", Keys{{"young", 1e10}, {"density", 2500}} + of.material)
              .region("behind",
                      {{"half_space", {{"point", point + 1e-9 * normal}, {"normal", normal}}}})
              .load("loads.start_velocity", {{"on", "behind"}, {"linear", -velocity}})
              .load("loads.start_velocity",
                    {{"on", {{"difference", {"all", "behind"}}}}, {"linear", velocity}})
              .solver("solvers.explicit", {{"end_time", 1e-3}})
              .text(),
          300, threads);
      const Body& body = thrown.body();
      EXPECT_EQ(parts_of(body).count, 2U) << of.type;
      const double time = thrown.simulation->time();
      const auto u = displacements(*thrown.simulation);
      Vec3 momentum, at_start;
      double off = 0;
      for (Particle p = 0; p < body.particles; ++p) {
        const bool is_beyond = dot(body.position(p) - point, normal) > 1e-9 * norm(normal) * 1.5;
        const Vec3 expected = (is_beyond ? time : -time) * velocity;
        off = std::max(off, norm(Vec3{u[3 * p], u[3 * p + 1], u[3 * p + 2]} - expected));
        at_start += (is_beyond ? 1 : -1) * thrown.plan->model->mass(p) * velocity;
        momentum += thrown.plan->model->mass(p) / time * Vec3{u[3 * p], u[3 * p + 1], u[3 * p + 2]};
      }
      EXPECT_GT(time * norm(velocity), 1e-5);
      EXPECT_LT(off, 1e-11 * 1e-2) << of.type << of.material.json();
      EXPECT_LT(norm(momentum - at_start), 1e-9 * thrown.plan->body.mass * norm(velocity));
      EXPECT_LT(std::abs(thrown.simulation->balance().stored), 1e-12);
    }
}

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

TEST(Cuts, PennyCrackOpensAsInTheClosedForm) {
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

}  // namespace
