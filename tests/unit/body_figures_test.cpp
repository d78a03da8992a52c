// The size of bodies against the size that their shape asks for, and the number of separate parts.
#include <model/body_figures.hpp>

#include <support/models.hpp>
#include <support/scenes.hpp>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <numbers>

namespace body_figures_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

Stages lattice(double spacing, const Json& shape, const std::string& boundary,
               const std::string& type = "lattices.cubic") {
  return stage(type, Keys{{"spacing", spacing}, {"shape", shape}} +
                         (boundary.empty() ? Keys{} : Keys{{"boundary", boundary}}));
}

std::unique_ptr<Plan> plan_with(const Stages& lattice) {
  return plan_of(SceneBuilder{}
                     .stages(lattice + elastic())
                     .solver("solvers.explicit", {{"end_time", 1e-6}})
                     .text());
}

BodyFigures figures(const Stages& lattice) {
  return body_figures(*build(lattice + elastic()).model);
}

TEST(BodyFigures, AWidthThatTheSpacingDoesNotDivideIsToldWithItsError) {
  for (const char* boundary : {"particles", "cells"}) {
    const auto plan = plan_with(lattice(3e-3, box_mm(24, 12, 8), boundary));
    const BodyFigures& body = plan->body;
    EXPECT_NEAR(norm(body.size - Vec3{24e-3, 12e-3, 9e-3}), 0, 1e-12) << boundary;
    EXPECT_NEAR(norm(*body.asked_size - Vec3{24e-3, 12e-3, 8e-3}), 0, 1e-12);
    EXPECT_NEAR(body.volume, 24e-3 * 12e-3 * 9e-3, 1e-15);
    EXPECT_NEAR(*body.asked_volume, 24e-3 * 12e-3 * 8e-3, 1e-15);
    EXPECT_NEAR(body.mass, 1000 * body.volume, 1e-12);
    EXPECT_NEAR(*body.asked_mass, 1000 * *body.asked_volume, 1e-12);
    ASSERT_EQ(plan->model->warnings.size(), 1u);
    EXPECT_EQ(plan->model->warnings[0],
              "along z the body is 0.009 m wide, 12.5 % more than the 0.008 m that its shape asks "
              "for: cells of 0.003 m do not fill that evenly");
    const auto json = plan_json(*plan);
    EXPECT_EQ(json.at("body").at("size").at(2), body.size.z);
    EXPECT_EQ(json.at("body").at("asked_size").at(2), 8e-3);
    const std::string page = plan_text(*plan);
    EXPECT_NE(page.find("0.024 x 0.012 x 0.009 m (shape: 0.024 x 0.012 x 0.008 m)"),
              std::string::npos)
        << page;
  }
}

TEST(BodyFigures, WhatFitsIsNotWarnedOf) {
  for (const char* boundary : {"particles", "cells"}) {
    const BodyFigures body = figures(lattice(1e-3, box_mm(4, 3, 2), boundary));
    EXPECT_TRUE(size_warnings(body, 1e-3).empty()) << boundary;
    EXPECT_EQ(body.parts.count, 1u);
  }
  const BodyFigures ball = figures(
      // The surface of cells has steps.
      lattice(1e-3, {{"sphere", {{"radius", 12e-3}}}}, "cells"));
  EXPECT_TRUE(size_warnings(ball, 1e-3).empty());
  EXPECT_NEAR(*ball.asked_volume, 4 * std::numbers::pi / 3 * std::pow(12e-3, 3), 1e-12);
  EXPECT_NEAR(ball.volume / *ball.asked_volume, 1, 0.02);
}

Json set(const std::string& kind, const Json& a, const Json& b) { return {{kind, {a, b}}}; }
Json half_space(Vec3 point, Vec3 normal) {
  return {{"half_space", {{"point", point}, {"normal", normal}}}};
}
Json cylinder(Vec3 start, Vec3 end, double radius) {
  return {{"cylinder", {{"start", start}, {"end", end}, {"radius", radius}}}};
}

std::vector<std::string> warnings(const Stages& lattice, double spacing = 3e-3) {
  return size_warnings(figures(lattice), spacing);
}

TEST(BodyFigures, ABoxWithAHoleIsComparedAsTheBoxIs) {
  const Json plate = box_mm(8, 8, 16);
  const Json bore = cylinder({4e-3, 4e-3, -1e-3}, {4e-3, 4e-3, 17e-3}, 2e-3);
  for (const char* boundary : {"particles", "cells"}) {
    const auto plain = warnings(lattice(3e-3, plate, boundary));
    EXPECT_EQ(plain.size(), 3u);
    EXPECT_EQ(warnings(lattice(3e-3, set("difference", plate, bore), boundary)), plain) << boundary;
    EXPECT_EQ(warnings(lattice(3e-3, set("intersection", plate, box({}, {1, 1, 16e-3})), boundary)),
              plain);
    EXPECT_EQ(
        warnings(lattice(3e-3, set("union", plate, set("difference", plate, bore)), boundary)),
        plain);
  }
  const BodyFigures even = figures(lattice(1e-3, set("difference", plate, bore), "cells"));
  EXPECT_FALSE(even.asked_at_most);
  EXPECT_TRUE(size_warnings(even, 1e-3).empty());
  const auto rod = [](double radius) { return cylinder({}, {0, 0, 8e-3}, radius); };
  const BodyFigures tube = figures(lattice(1e-3, set("difference", rod(4e-3), rod(2e-3)), "cells"));
  EXPECT_FALSE(tube.asked_at_most);
  EXPECT_NEAR(norm(*tube.asked_size - Vec3{8e-3, 8e-3, 8e-3}), 0, 1e-12);
  EXPECT_EQ(warnings(lattice(3e-3, set("difference", rod(4e-3), rod(1e-3)), "cells")).size(), 3u);
  const auto plan = plan_with(lattice(3e-3, set("difference", plate, bore), "cells"));
  EXPECT_EQ(plan->model->warnings.size(), 3u);
  EXPECT_EQ(plan_json(*plan).at("body").at("asked_size").at(2), 16e-3);
}

TEST(BodyFigures, WhatIsCutOffOverAWholeSideIsNotAskedFor) {
  const Json cube = box_mm(4, 4, 4);
  for (const Json& half : {set("difference", cube, half_space({2e-3, 0, 0}, {-1, 0, 0})),
                           set("difference", cube, box({2e-3, -1, -1}, {1, 1, 1})),
                           set("intersection", cube, half_space({2e-3, 0, 0}, {1, 0, 0}))}) {
    const BodyFigures body = figures(lattice(1e-3, half, "particles"));
    EXPECT_NEAR(norm(body.size - Vec3{2e-3, 4e-3, 4e-3}), 0, 1e-12) << half;
    EXPECT_NEAR(norm(*body.asked_size - Vec3{2e-3, 4e-3, 4e-3}), 0, 1e-12) << half;
    EXPECT_FALSE(body.asked_at_most);
    EXPECT_FALSE(body.asked_volume);
  }
}

TEST(BodyFigures, AnExtentThatIsOnlyABoundIsToldAsOne) {
  // The slanting half-space removes the whole side at x = 4 mm. The box around the two solids is
  // then larger than their difference.
  const Json slanting = set("difference", box_mm(4, 4, 4), half_space({2e-3, 0, 0}, {-1, 0.1, 0}));
  const BodyFigures body = figures(lattice(1e-3, slanting, "particles"));
  EXPECT_TRUE(body.asked_at_most);
  EXPECT_TRUE(size_warnings(body, 1e-3).empty()) << "narrower than a bound is no error";
  EXPECT_NE(body_lines(body)[0].second.find(" (shape: at most 0.004 x 0.004 x 0.004 m)"),
            std::string::npos)
      << body_lines(body)[0].second;
}

TEST(BodyFigures, LatticesOfMoreThanOneParticleACubeAreComparedToo) {
  for (const char* type : {"lattices.bcc", "lattices.fcc"}) {
    const BodyFigures even = figures(lattice(1e-3, box_mm(4, 3, 2), "", type));
    EXPECT_NEAR(norm(even.size - Vec3{4e-3, 3e-3, 2e-3}), 0, 1e-12) << type;
    EXPECT_TRUE(size_warnings(even, 1e-3).empty());
    const BodyFigures odd = figures(lattice(3e-3, box_mm(8, 8, 16), "", type));
    EXPECT_NEAR(norm(odd.size - Vec3{7.5e-3, 7.5e-3, 16.5e-3}), 0, 1e-12) << type;
    EXPECT_EQ(size_warnings(odd, 3e-3).size(), 3u);
    EXPECT_EQ(body_lines(odd)[0].second,
              "0.0075 x 0.0075 x 0.0165 m (shape: 0.008 x 0.008 x 0.016 m)");
  }
  const BodyFigures full = figures(lattice(1e-3, box({}, {2.5e-3, 2.5e-3, 2.5e-3}), "",
                                           "lattices.bcc"));  // right size; 35 particles, not 31.25
  EXPECT_EQ(
      size_warnings(full, 1e-3),
      std::vector<std::string>{
          "the body has 12 % more volume than its shape asks for: cells of 0.001 m do not fill "
          "that evenly"});
}

TEST(BodyFigures, CountsBodiesThatNoSpringJoins) {
  const auto two = [](double low, const char* boundary, const char* type) {
    const Json shape = set("union", box_mm(4, 3, 3), box({0, 0, low}, {4e-3, 3e-3, 8e-3}));
    return figures(lattice(1e-3, shape, boundary, type)).parts.count;
  };
  EXPECT_EQ(two(3e-3, "particles", "lattices.cubic"), 1u) << "neighbouring cells are joined";
  EXPECT_EQ(two(4e-3, "particles", "lattices.cubic"), 2u) << "an empty cell parts them";
  EXPECT_EQ(two(4e-3, "cells", "lattices.cubic"), 2u);
  EXPECT_EQ(two(5e-3, "", "lattices.bcc"), 2u);
  EXPECT_EQ(two(5e-3, "", "lattices.fcc"), 2u);
  EXPECT_EQ(two(3e-3, "", "lattices.fcc"), 1u);
}

TEST(BodyFigures, CountsAsASearchThroughAllSpringsDoes) {
  const auto sphere = [](double radius, Vec3 centre) -> Json {
    return {{"sphere", {{"radius", radius}, {"centre", centre}}}};
  };
  const Json shapes[] = {sphere(4.4e-3, {}),
                         {{"union",
                           {sphere(2e-3, {}), sphere(1.2e-3, {4e-3, 0, 0}),
                            cylinder({0, 6e-3, 0}, {5e-3, 9e-3, 4e-3}, 0.8e-3)}}}};
  for (const Json& shape : shapes)
    for (const char* type : {"lattices.cubic", "lattices.bcc", "lattices.fcc"}) {
      const BuiltScene built = build(lattice(1e-3, shape, "", type) + elastic());
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
      EXPECT_EQ(parts_of(built->body).count, parts) << type << shape;
    }
}

}  // namespace body_figures_test
