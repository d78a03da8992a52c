// Pictures of writers.render against closed forms: projected areas, colours, gaps, cracks, cuts.
#include <support/render_block.hpp>

#include <picture/palette.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>

namespace hyperlattice::test {
namespace render_test {

using nlohmann::json;
using picture::Colour;

bool is_white(const png_byte* pixel) {
  return pixel[0] == 255 && pixel[1] == 255 && pixel[2] == 255;
}

/// Where something is drawn.
struct Extent {
  int left = 1 << 30, right = -1, top = 1 << 30, bottom = -1;
  double area = 0;  ///< pixels, with the parts of pixels at edges
  int width() const { return right - left + 1; }
  int height() const { return bottom - top + 1; }
};

/// Returns the extent of a body of one colour. The light of a pixel is the square of its number.
Extent extent_of(const Pixels& pixels, Colour colour) {
  Extent extent;
  const double full = 1 - std::pow(colour[0] / 255.0, 2);
  for (int y = 0; y < pixels.height; ++y)
    for (int x = 0; x < pixels.width; ++x) {
      const png_byte* pixel = pixels.at(x, y);
      if (is_white(pixel)) continue;
      extent.area += (1 - std::pow(pixel[0] / 255.0, 2)) / full;
      extent.left = std::min(extent.left, x);
      extent.right = std::max(extent.right, x);
      extent.top = std::min(extent.top, y);
      extent.bottom = std::max(extent.bottom, y);
    }
  return extent;
}

const Colour zero_colour = picture::viridis(0);

/// Returns the rotation by an angle about an axis of length 1 (Rodrigues).
std::function<Vec3(Vec3)> turned(Vec3 axis, double angle) {
  return [=](Vec3 v) {
    return std::cos(angle) * v + std::sin(angle) * cross(axis, v) +
           (1 - std::cos(angle)) * dot(axis, v) * axis;
  };
}

// The projection of a cube of edge a has the area a^2 (|n.x| + |n.y| + |n.z|), with the directions
// of its edges x y z and the direction n of the eye. Its extents follow in the same way.
TEST(Render, ATurnedCubeHasTheAreaOfItsProjection) {
  for (const bool corners : {false, true}) {
    Block block({5, 5, 5}, corners);
    const auto turn = turned(direction_of({1, 2, 3}), 0.7);
    block.move(turn);
    const Extent extent = extent_of(draw(block, bare({{"from", "z"}})), zero_colour);
    const auto sum = [&](Vec3 along) {
      double all = 0;
      for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
        all += std::abs(dot(along, turn(axis)));
      return all;
    };
    const double wide = sum({1, 0, 0}), high = sum({0, 1, 0}), seen = sum({0, 0, 1});
    EXPECT_NEAR(extent.width() * high / (extent.height() * wide), 1, 0.01);
    const double edge = 0.5 * (extent.width() / wide + extent.height() / high);  // pixels
    EXPECT_NEAR(extent.area / (edge * edge), seen, 0.012 * seen);
    EXPECT_GT(extent.width(), 400);  // the frame is filled
  }
}

TEST(Render, UpPointsUp) {
  const auto width_by_height = [](json options) {
    Block block({2, 3, 6});
    const Extent extent = extent_of(draw(block, bare(std::move(options))), zero_colour);
    return 1.0 * extent.width() / extent.height();
  };
  EXPECT_NEAR(width_by_height({{"from", "z"}}), 2.0 / 3, 0.01);
  EXPECT_NEAR(width_by_height({{"from", "z"}, {"up", {1, 0, 0}}}), 3.0 / 2, 0.01);
  EXPECT_NEAR(width_by_height({{"from", "y"}}), 2.0 / 6, 0.01);
  EXPECT_NEAR(width_by_height({{"from", "x"}, {"up", {0, 1, 0}}}), 6.0 / 3, 0.01);
  EXPECT_NEAR(width_by_height({{"from", "x"}, {"up", {1, 0, 0}}}), 3.0 / 6, 0.01);  // at the eye
}

TEST(Render, AUniformFieldHasTheColourOfTheLegend) {
  Block block({3, 3, 3});
  block.pressure.assign(block.particles, 0.37);
  const Colour colour = picture::colour_of(picture::ColourMap::cividis, 0.37);
  const json options = bare({{"colour_map", "cividis"}, {"legend", true}});
  const Pixels pixels = draw(block, options);
  EXPECT_EQ(0, std::memcmp(pixels.at(200, 250), colour.data(), 3));
  int like_it = 0;  // in the legend, which has the colours of one step above and below
  for (int y = 0; y < pixels.height; ++y)
    for (int x = 440; x < pixels.width; ++x) {
      int apart = 0;
      for (std::size_t n = 0; n < 3; ++n)
        apart = std::max(apart, std::abs(pixels.at(x, y)[n] - colour[n]));
      if (apart <= 2) ++like_it;
    }
  EXPECT_GT(like_it, 5);
}

/// Returns how many white pixels lie between others of their row.
int gaps(const Pixels& pixels) {
  int count = 0;
  for (int y = 0; y < pixels.height; ++y) {
    int first = pixels.width, last = -1;
    for (int x = 0; x < pixels.width; ++x)
      if (!is_white(pixels.at(x, y))) {
        first = std::min(first, x);
        last = x;
      }
    for (int x = first; x < last; ++x)
      if (is_white(pixels.at(x, y))) ++count;
  }
  return count;
}

// A sheared block is convex. From y and z a bent one hides no background behind its rim either.
TEST(Render, AShearedBodyHasNoGaps) {
  for (const bool corners : {false, true})
    for (const auto& [from, bend] : {std::pair{"isometric", 0}, {"y", 300}, {"z", 300}}) {
      Block block({6, 6, 6}, corners);
      block.move([bend = bend](Vec3 x) {
        return Vec3{x.x + 1.5 * x.z + bend * x.y * x.y, x.y - 0.4 * x.x, 1.4 * x.z};
      });
      EXPECT_EQ(gaps(draw(block, bare({{"from", from}}))), 0) << from << corners;
    }
}

TEST(Render, NeighboursPartOnlyAtBrokenSprings) {
  const auto pixels_of = [](bool broken, json options = json::object()) {
    Block block({4, 2, 2});
    block.move([](Vec3 x) { return x + (x.x > 2e-3 ? Vec3{1e-3, 0, 0} : Vec3{}); });
    for (const Particle row : {0U, 4U, 8U, 12U})
      if (broken) block.break_spring(row + 1, row + 2);
    for (Particle n = 0; n < block.particles; ++n) block.fragment[n] = broken && n % 4 > 1 ? 1 : 0;
    options.update({{"view", {0.3, -1, 0}}});
    return draw(block, bare(options));
  };
  const auto dark = [](const Pixels& pixels) {
    int count = 0;
    for (int y = 0; y < pixels.height; ++y)
      for (int x = 0; x < pixels.width; ++x)
        if (pixels.at(x, y)[0] == 40 && pixels.at(x, y)[1] == 40) ++count;
    return count;
  };
  EXPECT_EQ(gaps(pixels_of(false)), 0);
  EXPECT_GT(gaps(pixels_of(true)), 1000);
  EXPECT_EQ(dark(pixels_of(true)), 0);
  EXPECT_GT(dark(pixels_of(true, {{"cracks", true}})), 500);
  EXPECT_EQ(dark(pixels_of(false, {{"cracks", true}})), 0);
}

TEST(Render, BrokenSpringsAreLinesInsideATransparentBody) {
  const auto vermilion = [](bool springs) {
    Block block({4, 4, 4});
    block.break_spring(21, 22);
    const Pixels pixels =
        draw(block, bare({{"springs", springs}, {"opacity", 0.05}, {"from", "y"}}));
    int count = 0;
    for (int y = 0; y < pixels.height; ++y)
      for (int x = 0; x < pixels.width; ++x)
        if (pixels.at(x, y)[1] > pixels.at(x, y)[0] + 60) ++count;  // closed: green
    return count;
  };
  EXPECT_EQ(vermilion(false), 0);
  EXPECT_GT(vermilion(true), 100);
}

// A ray passes through the front and the back of a body.
TEST(Render, OpacityMixesTheLayers) {
  Block block({2, 2, 2});
  const Pixels pixels = draw(block, bare({{"opacity", 0.6}, {"from", "x"}}));
  for (std::size_t n = 0; n < 3; ++n) {
    const double body = std::pow(zero_colour[n] / 255.0, 2),
                 light = 0.6 * body + 0.4 * 0.6 * body + 0.4 * 0.4;
    EXPECT_NEAR(pixels.at(250, 250)[n], 255 * std::sqrt(light), 1);
  }
}

// The plane takes the upper half away. Seen from above, its face shows the middle of the body.
TEST(Render, APlaneCutsFlat) {
  Block block({4, 4, 5});
  for (Particle n = 0; n < block.particles; ++n) block.pressure[n] = n / 16 == 2 ? 1 : 0;
  const json clip{0, 0, 2.3e-3, 0, 0, 5};
  const Extent side =
      extent_of(draw(block, bare({{"clip", clip}, {"from", "y"}, {"colour_map", "grey"}})),
                picture::colour_of(picture::ColourMap::grey, 0));
  EXPECT_NEAR(static_cast<double>(side.height()) / side.width(), 2.3 / 4, 0.005);
  const Pixels above = draw(block, bare({{"clip", clip}, {"from", "z"}}));
  const Colour one = picture::viridis(1);
  EXPECT_EQ(0, std::memcmp(above.at(250, 250), one.data(), 3));
  const Extent extent = extent_of(above, one);
  EXPECT_EQ(gaps(above), 0);
  EXPECT_NEAR(extent.width(), extent.height(), 1);
  // A turned body and an oblique plane through its centre: the section of a cube across a diagonal
  // of a face is a rectangle of edges a and a sqrt(2), seen along the normal of the plane.
  Block cube({4, 4, 4});
  const Extent section = extent_of(
      draw(cube, bare({{"clip", {2e-3, 2e-3, 2e-3, 1, 1, 0}}, {"view", {1, 1, 0}}})), zero_colour);
  EXPECT_NEAR(static_cast<double>(section.width()) / section.height(), std::numbers::sqrt2, 0.01);
  EXPECT_NEAR(section.area, 1.0 * section.width() * section.height(), 0.01 * section.area);
}

// The silhouette of a ball of cubes is a stair of few steps. Smoothed, it has another width in
// nearly each row, and the area of a disc.
TEST(Render, SmoothingTakesTheStepsOfABall) {
  double share = 0;
  for (const int steps : {0, 20}) {
    Block block({15, 15, 15});
    block.keep([](Vec3 x) { return norm(x - Vec3{7.5e-3, 7.5e-3, 7.5e-3}) < 7e-3; });
    const Pixels pixels = draw(block, bare({{"from", "z"}, {"smooth", steps}}));
    const Extent extent = extent_of(pixels, zero_colour);
    share = extent.area / (1.0 * extent.width() * extent.height());
    std::set<int> starts;
    for (int y = extent.top; y <= extent.bottom; ++y) {
      int x = 0;
      while (pixels.at(x, y)[0] > 160) ++x;
      starts.insert(x);
    }
    if (steps == 0)
      EXPECT_LE(starts.size(), 10U);
    else
      EXPECT_GT(starts.size(), 80U);
  }
  EXPECT_NEAR(share, std::numbers::pi / 4, 0.01);
}

TEST(Render, TheOutlineIsDarkAndThin) {
  Block block({3, 3, 3});
  block.pressure.assign(block.particles, 0.9);
  const Pixels pixels =
      draw(block, bare({{"outline", true}, {"from", "z"}, {"colour_map", "grey"}}));
  const auto value = [&](int x) { return static_cast<int>(pixels.at(x, 250)[0]); };
  int first = 0;
  while (value(first) == 255) ++first;
  EXPECT_LT(std::min(value(first), value(first + 1)), 200);  // the body itself: 215
  EXPECT_EQ(value(first + 4), picture::colour_of(picture::ColourMap::grey, 0.9)[0]);
}

TEST(Render, TextsOfSvgStayTexts) {
  Block block({2, 2, 2});
  json options{{"colour_by", "failure"}, {"format", "svg"}, {"width", 300}, {"height", 200}};
  const std::string svg = draw_file(block, options, "svg");
  for (const char* text :
       {">open failure</text>", ">closed failure</text>", ">intact</text>",
        ">A block &amp; its title</text>", ">t = 2 \u00b5s</text>", "mm</text>", ">x</text>"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  options["format"] = "pdf";
  const std::string pdf = draw_file(block, options, "pdf");
  EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
  EXPECT_NE(pdf.find("/FontFile"), std::string::npos);  // the font is in the file
  EXPECT_EQ(pdf, draw_file(block, options, "pdf"));
}

TEST(Render, DrawsNothingWhereNothingIsLeft) {
  Block block({2, 2, 2});
  const Pixels pixels =
      draw(block, {{"clip", {0, 0, -1, 0, 0, 1}}, {"colour_by", "pressure"}, {"legend", false}});
  EXPECT_TRUE(is_white(pixels.at(pixels.width / 2, pixels.height / 2)));
}

// A scale whose numbers hardly differ, and one that has no end.
TEST(Render, TakesAnyNumbers) {
  for (const double step : {1e-300, 1e-16, 16.0, 1e300}) {
    Block block({2, 2, 2});
    for (Particle n = 0; n < block.particles; ++n)
      block.pressure[n] = step < 20 ? 1e17 + step * double(n) : step * double(n);
    json options = bare({{"legend", true}});
    options.erase("range");
    EXPECT_GT(draw(block, options).width, 0);
  }
}

// With "fit": "rest" a body may move where the legend is.
TEST(Render, ABodyThatMovesAwayDoesNotCoverTheLegend) {
  const auto moved = [](Vec3 by) {
    Block block({3, 3, 3});
    block.move([by](Vec3 x) { return x + by; });
    return draw(block,
                bare({{"legend", true}, {"title", "A title"}, {"fit", "rest"}, {"from", "z"}}));
  };
  const Pixels inside = moved({1.2e-3, 1.2e-3, 0}), outside = moved({1, 0, 0});
  constexpr int legend = 446, body = 420, title = 21, head = 30;
  int seen = 0;
  for (int y = 0; y < inside.height; ++y)
    for (int x = 0; x < inside.width; ++x) {
      const bool is_same = std::memcmp(inside.at(x, y), outside.at(x, y), 3) == 0;
      if (x >= legend || y < title) {
        EXPECT_TRUE(is_same) << x << " " << y;
      }
      if (x < body && y > head && !is_same) ++seen;
    }
  EXPECT_GT(seen, 10000);
}

TEST(Render, ALongTitleIsCut) {
  Block block({2, 2, 2});
  for (const std::string word : {"a word ", "\u00e4\u2211", "\u0001\n<&>"}) {
    std::string title;
    for (int n = 0; n < 100; ++n) title += word;
    const std::string svg = draw_file(block, bare({{"title", title}, {"format", "svg"}}), "svg");
    EXPECT_NE(svg.find("\u2026</text>"), std::string::npos) << svg.substr(svg.size() - 500);
    EXPECT_NE(svg.find(">t = 2 \u00b5s</text>"), std::string::npos);
    EXPECT_EQ(svg.find('\1'), std::string::npos);
  }
}

// A body may collapse or be lost; the run's guard, not the picture, stops it.
TEST(Render, DrawsBodiesThatHaveNoSizeOrNoPlace) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vec3 by : {Vec3{0, 0, 0}, Vec3{nan, nan, nan}, Vec3{1e200, 0, 0}}) {
    Block block({3, 3, 3});
    block.move([by](Vec3) { return by; });
    for (const char* camera : {"orthographic", "perspective"})
      EXPECT_EQ(draw(block, bare({{"camera", camera}})).width, 500);
  }
  Block block({3, 3, 3});
  block.displacement[0] = nan;
  block.pressure[26] = nan;
  EXPECT_EQ(draw(block, bare({{"smooth", 3}})).width, 500);
  const std::string svg = draw_file(block, bare({{"legend", true}, {"format", "svg"}}), "svg");
  EXPECT_NE(svg.find(">no value</text>"), std::string::npos);
}

TEST(Render, RefusesWhatDoesNotFit) {
  const auto faults = [](const json& options) {
    return Plugin("writers.render", options).faults();
  };
  EXPECT_TRUE(faults(json::object()).empty());
  const std::pair<json, const char*> wrong[] = {
      {{{"clip", {1, 2, 3}}}, "clip: "},
      {{{"clip", {1, 2, 3, 0, 0, 0}}}, "clip: "},
      {{{"range", {1, 1}}}, "range: "},
      {{{"azimuth", 1}}, "elevation: "},
      {{{"azimuth", 1}, {"elevation", 1}, {"view", {1, 0, 0}}}, "view: "},
      {{{"movie", "gif"}, {"format", "pdf"}}, "format: "},
      {{{"file", "../x"}}, "file: "}};
  for (const auto& [options, fault] : wrong) {
    const auto found = faults(options);
    ASSERT_EQ(found.size(), 1U) << options;
    EXPECT_EQ(found[0].rfind(fault, 0), 0U) << found[0];
  }
}

}  // namespace render_test
}  // namespace hyperlattice::test
