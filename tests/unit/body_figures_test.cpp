// How large bodies come out, and how many there are.
#include <model/body_figures.hpp>

#include <support/models.hpp>
#include <support/scenes.hpp>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <numbers>

namespace {
using namespace hyperlattice;
using namespace hyperlattice::test;

std::string lattice(const std::string& spacing, const std::string& shape, const std::string& boundary, const std::string& type = "lattices.cubic") {
  return R"({ "type": ")" + type + R"(", "spacing": )" + spacing + (boundary.empty() ? "" : R"(, "boundary": ")" + boundary + "\"") +
         R"(, "shape": )" + shape + " }, ";
}
std::string box(const std::string& high) { return R"({ "box": { "low": [0, 0, 0], "high": )" + high + " } }"; }

BodyFigures figures(const std::string& lattice) { return body_figures(*build(lattice + elastic()).model); }

TEST(BodyFigures, AWidthThatTheSpacingDoesNotDivideIsToldWithItsError) {
  for (const char* boundary : {"particles", "cells"}) {
    const auto plan = plan_of(R"({ "format": "hyperlattice/1", "pipeline": [ )" + lattice("3e-3", box("[24e-3, 12e-3, 8e-3]"), boundary) + elastic() +
                              R"(, { "type": "solvers.explicit", "end_time": 1e-6 } ] })");
    const BodyFigures& body = plan->body;
    EXPECT_NEAR(norm(*body.size - Vec3{24e-3, 12e-3, 9e-3}), 0, 1e-12) << boundary;
    EXPECT_NEAR(norm(*body.asked_size - Vec3{24e-3, 12e-3, 8e-3}), 0, 1e-12);
    EXPECT_NEAR(body.volume, 24e-3 * 12e-3 * 9e-3, 1e-15);
    EXPECT_NEAR(*body.asked_volume, 24e-3 * 12e-3 * 8e-3, 1e-15);
    EXPECT_NEAR(body.mass, 1000 * body.volume, 1e-12);
    EXPECT_NEAR(*body.asked_mass, 1000 * *body.asked_volume, 1e-12);
    ASSERT_EQ(plan->model->warnings.size(), 1u);
    EXPECT_EQ(plan->model->warnings[0],
              "along z the body is 0.009 m wide, 12.5 % more than the 0.008 m that its shape asks for: cells of 0.003 m do not fill that evenly");
    const auto json = plan_json(*plan);
    EXPECT_EQ(json.at("body").at("size").at(2), body.size->z);
    EXPECT_EQ(json.at("body").at("asked_size").at(2), 8e-3);
    const std::string page = plan_text(*plan);
    EXPECT_NE(page.find("0.024 x 0.012 x 0.009 m; its shape asks for 0.024 x 0.012 x 0.008 m"), std::string::npos) << page;
  }
}

TEST(BodyFigures, WhatFitsIsNotWarnedOf) {
  for (const char* boundary : {"particles", "cells"}) {
    const BodyFigures body = figures(lattice("1e-3", box("[4e-3, 3e-3, 2e-3]"), boundary));
    EXPECT_TRUE(size_warnings(body, 1e-3).empty()) << boundary;
    EXPECT_EQ(body.parts, 1u);
  }
  const BodyFigures ball = figures(lattice("1e-3", R"({ "sphere": { "radius": 12e-3 } })", "cells"));  // its surface is steps
  EXPECT_TRUE(size_warnings(ball, 1e-3).empty());
  EXPECT_NEAR(*ball.asked_volume, 4 * std::numbers::pi / 3 * std::pow(12e-3, 3), 1e-12);
  EXPECT_NEAR(ball.volume / *ball.asked_volume, 1, 0.02);
}

TEST(BodyFigures, ACutShapeHasNoSizeToCompareWith) {
  const std::string half =
      R"({ "difference": [ )" + box("[4e-3, 4e-3, 4e-3]") + R"(, { "half_space": { "point": [2e-3, 0, 0], "normal": [1, 0, 0] } } ] })";
  const BodyFigures body = figures(lattice("1e-3", half, "particles"));
  EXPECT_FALSE(body.asked_size);
  EXPECT_FALSE(body.asked_volume);
}

TEST(BodyFigures, CountsBodiesThatNoSpringJoins) {
  const auto two = [](const std::string& gap_low, const char* boundary, const char* type) {
    return figures(lattice("1e-3",
                           R"({ "union": [ { "box": { "low": [0, 0, 0], "high": [4e-3, 3e-3, 3e-3] } }, { "box": { "low": [0, 0, )" + gap_low +
                               R"(], "high": [4e-3, 3e-3, 8e-3] } } ] })",
                           boundary, type))
        .parts;
  };
  EXPECT_EQ(two("3e-3", "particles", "lattices.cubic"), 1u) << "neighbouring cells are joined";
  EXPECT_EQ(two("4e-3", "particles", "lattices.cubic"), 2u) << "an empty cell parts them";
  EXPECT_EQ(two("4e-3", "cells", "lattices.cubic"), 2u);
  EXPECT_EQ(two("5e-3", "", "lattices.bcc"), 2u);
  EXPECT_EQ(two("5e-3", "", "lattices.fcc"), 2u);
  EXPECT_EQ(two("3e-3", "", "lattices.fcc"), 1u);
}

TEST(BodyFigures, CountsAsASearchThroughAllSpringsDoes) {
  const std::string shapes[] = {R"({ "sphere": { "radius": 4.4e-3 } })",
                                R"({ "union": [ { "sphere": { "radius": 2e-3 } }, { "sphere": { "radius": 1.2e-3, "centre": [4e-3, 0, 0] } },
                                                { "cylinder": { "start": [0, 6e-3, 0], "end": [5e-3, 9e-3, 4e-3], "radius": 0.8e-3 } } ] })"};
  for (const std::string& shape : shapes)
    for (const char* type : {"lattices.cubic", "lattices.bcc", "lattices.fcc"}) {
      const BuiltScene built = build(lattice("1e-3", shape, "", type) + elastic());
      std::vector<Particle> first(built->body.particles);
      for (Particle p = 0; p < first.size(); ++p) first[p] = p;
      for (bool changed = true; changed;) {
        changed = false;
        built->body.for_springs([&](Particle a, Particle b, std::uint32_t) {
          changed = changed || first[a] != first[b];
          first[a] = first[b] = std::min(first[a], first[b]);
        });
      }
      std::uint64_t parts = 0;
      for (Particle p = 0; p < first.size(); ++p) parts += first[p] == p ? 1 : 0;
      EXPECT_EQ(count_parts(built->body), parts) << type << shape;
    }
}

}  // namespace
