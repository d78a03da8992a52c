// Pictures of writers.render against closed forms: projected areas, colours, gaps, cracks, cuts.
#include <support/output.hpp>
#include <support/png.hpp>
#include <support/program.hpp>

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

/// A block of particles, 1 mm apart: cubes of 1 mm, or the corners of cells of 1 mm.
class Block {
 public:
  explicit Block(std::array<std::int32_t, 3> count, bool corners_of_cells = false) {
    for (std::int32_t k = 0; k < count[2]; ++k)
      for (std::int32_t j = 0; j < count[1]; ++j)
        for (std::int32_t i = 0; i < count[0]; ++i)
          positions_.insert(positions_.end(),
                            {edge * (i + 0.5), edge * (j + 0.5), edge * (k + 0.5)});
    particles = positions_.size() / 3;
    for (Particle n = 0; n < particles; ++n) all_.push_back(n);
    displacement.assign(positions_.size(), 0);
    pressure.assign(particles, 0);
    open.assign(particles, 0);
    closed.assign(particles, 0);
    fragment.assign(particles, 0);
    take_cubes(count, corners_of_cells);
  }

  /// Moves each particle from its place at rest, m, to another one.
  void move(const std::function<Vec3(Vec3)>& to) {
    for (Particle n = 0; n < particles; ++n) {
      const Vec3 from{positions_[3 * n], positions_[3 * n + 1], positions_[3 * n + 2]},
          now = to(from);
      for (std::size_t axis = 0; axis < 3; ++axis)
        displacement[3 * n + axis] = now[axis] - from[axis];
    }
  }
  /// Takes the cubes away whose middle is not inside.
  void keep(const std::function<bool(Vec3)>& inside) {
    for (std::size_t n = 0; n < owners_.size(); ++n) {
      const auto nx = static_cast<std::size_t>(cubes_.count[0]),
                 ny = static_cast<std::size_t>(cubes_.count[1]);
      const Vec3 place{double(n % nx), double(n / nx % ny), double(n / nx / ny)};
      if (!inside(cubes_.origin + cubes_.edge * (place + Vec3{0.5, 0.5, 0.5})))
        owners_[n] = BodyCubes::no_particle;
    }
  }
  /// Breaks the spring between two particles.
  void break_spring(Particle a, Particle b) {
    CrackFace face;
    face.a = a;
    face.b = b;
    face.area = edge * edge;
    face.damage = 1;
    faces_.push_back(face);
  }

  OutputContext context(std::string_view directory) {
    OutputContext context;
    context.directory = directory;
    context.title = "A block & its title";
    context.self = this;
    context.region_particles = [](void* self, RegionId) noexcept -> std::span<const Particle> {
      return static_cast<Block*>(self)->all_;
    };
    context.receive_warning = [](void* self, std::string_view sentence) noexcept {
      static_cast<Block*>(self)->warnings.emplace_back(sentence);
    };
    return context;
  }
  Snapshot snapshot() {
    Snapshot snapshot;
    snapshot.time = 2e-6;
    snapshot.particles = particles;
    snapshot.spacing = edge;
    snapshot.positions = positions_;
    snapshot.self = this;
    snapshot.get_field = [](void* self, std::string_view name, Field& field) noexcept {
      auto& block = *static_cast<Block*>(self);
      const std::pair<std::string_view, Field> fields[] = {
          {"displacement", {3, block.displacement}},
          {"pressure", {1, block.pressure}},
          {"broken_open", {1, block.open}},
          {"broken_closed", {1, block.closed}}};
      for (const auto& [known, values] : fields)
        if (known == name) {
          field = values;
          return true;
        }
      return false;
    };
    snapshot.get_fragments = [](void* self, double, Field& numbers) noexcept {
      numbers = {1, static_cast<Block*>(self)->fragment};
      return true;
    };
    snapshot.get_crack_faces = [](void* self, double) noexcept {
      return std::span<const CrackFace>(static_cast<Block*>(self)->faces_);
    };
    snapshot.get_cubes = [](void* self) noexcept {
      auto& block = *static_cast<Block*>(self);
      block.cubes_.particle = block.owners_;
      return block.cubes_;
    };
    return snapshot;
  }

  static constexpr double edge = 1e-3;
  std::uint64_t particles = 0;
  std::vector<double> displacement, pressure, open, closed, fragment;
  std::vector<std::string> warnings;

 private:
  void take_cubes(std::array<std::int32_t, 3> count, bool corners_of_cells) {
    const std::int32_t parts = corners_of_cells ? 2 : 1, less = corners_of_cells ? 1 : 0;
    cubes_.edge = edge / parts;
    const double low = corners_of_cells ? edge / 2 : 0;
    cubes_.origin = {low, low, low};
    for (int axis = 0; axis < 3; ++axis)
      cubes_.count[axis] = parts * (count[static_cast<std::size_t>(axis)] - less);
    for (std::int32_t k = 0; k < cubes_.count[2]; ++k)
      for (std::int32_t j = 0; j < cubes_.count[1]; ++j)
        for (std::int32_t i = 0; i < cubes_.count[0]; ++i) {
          const auto at = [&](std::int32_t n) { return (n + less) / parts; };
          owners_.push_back(
              static_cast<std::uint32_t>((at(k) * count[1] + at(j)) * count[0] + at(i)));
        }
  }

  std::vector<double> positions_;
  std::vector<Particle> all_;
  std::vector<CrackFace> faces_;
  std::vector<std::uint32_t> owners_;
  BodyCubes cubes_;
};

/// Options without texts and light: colours are exactly those of the particles.
json bare(json more = json::object()) {
  json options{{"title", ""},      {"legend", false}, {"scale_bar", false},      {"axes", false},
               {"outline", false}, {"light", 0},      {"colour_by", "pressure"}, {"range", {0, 1}},
               {"width", 500},     {"height", 500}};
  options.update(more);
  return options;
}

std::string draw_file(Block& block, const json& options, const std::string& extension = "png") {
  const Folder folder("render");
  Plugin writer("writers.render", options);
  writer.begin(block.context(folder.path()));
  writer.frame(block.snapshot());
  writer.end();
  return contents(folder.file("render_000000." + extension));
}

Pixels draw(Block& block, const json& options) {
  const Folder folder("render_png");
  const std::string file = folder.file("picture.png");
  std::ofstream(file, std::ios::binary) << draw_file(block, options);
  return read_png(file);
}

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
    for (const Particle row : {0, 4, 8, 12})
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

Launch with(const std::string& setting) {
  Launch launch;
  launch.environment = {setting};
  return launch;
}

/// A scene of a breaking sphere with this writer.
json sphere_with(json writer) {
  json scene = small_sphere();
  scene["pipeline"][1]["failure"] = {{"type", "failures.elongation"}, {"limit", "1e-3 mm"}};
  writer.update({{"type", "writers.render"}, {"width", 200}, {"height", 150}});
  scene["pipeline"].push_back(writer);
  return scene;
}

TEST(RenderRuns, SameBitsForAnyThreadsAndNoDisplay) {
  const Folder folder("render_runs");
  const std::string scene = write_scene(
      folder,
      sphere_with(
          {{"every", "5 us"}, {"clip", {0, 0, 0, 1, -1, 0}}, {"smooth", 5}, {"cracks", true}}));
  for (const char* threads : {"1", "2"}) {
    const Result result = run_program(
        {"run", scene, "--out", folder.file(threads), "--threads", threads}, with("DISPLAY="));
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  for (const char* name : {"render_000000.png", "render_000001.png", "render_000002.png"}) {
    const std::string one = contents(folder.file("1/" + std::string(name)));
    EXPECT_GT(one.size(), 1000U);
    EXPECT_TRUE(one == contents(folder.file("2/" + std::string(name)))) << name;
  }
  EXPECT_NE(contents(folder.file("1/render_000000.png")),
            contents(folder.file("1/render_000002.png")));
}

TEST(RenderRuns, FaultsPointAtTheOption) {
  const Folder folder("render_faults");
  const std::string scene = write_scene(
      folder, sphere_with({{"clip", {1, 2}}, {"opacity", 0}, {"colour_by", "presure"}}));
  const Result result = run_program({"plan", scene});
  EXPECT_EQ(result.exit_code, 2);
  for (const char* pointer : {"/pipeline/4/opacity", "/pipeline/4/colour_by"})
    EXPECT_NE(result.err.find(pointer), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("pressure"), std::string::npos);  // the nearest valid name
}

TEST(RenderRuns, AFullDiskIsExitCode4) {
  const Folder folder("render_disk");
  const std::string scene = write_scene(folder, sphere_with({{"every", 0}, {"width", 2000}}));
  Launch limited;
  limited.file_limit = 20000;
  const Result result = run_program({"run", scene, "--out", folder.file("out")}, limited);
  EXPECT_EQ(result.exit_code, 4) << result.err;
}

/// Puts a program named ffmpeg into a folder. It writes its arguments to the last of them.
void fake_ffmpeg(const Folder& folder, const std::string& script) {
  std::ofstream(folder.file("ffmpeg")) << "#!/bin/sh\n" << script;
  std::filesystem::permissions(folder.file("ffmpeg"), std::filesystem::perms::owner_all);
}

TEST(RenderRuns, AFilmIsMadeOfAllFrames) {
  const Folder folder("render_film");
  fake_ffmpeg(folder, "for last; do :; done\necho \"$@\" > \"$last\"\n");
  const std::string scene = write_scene(folder, sphere_with({{"every", "5 us"}, {"movie", "mp4"}}));
  const Result result =
      run_program({"run", scene, "--out", folder.file("out")}, with("PATH=" + folder.path()));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string told = contents(folder.file("out/render.mp4"));
  EXPECT_NE(told.find("render_%06d.png"), std::string::npos) << told;
  EXPECT_TRUE(std::filesystem::exists(folder.file("out/render_000002.png")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("out/render.mp4.part")));
}

TEST(RenderRuns, AFilmThatFailsLeavesTheFrames) {
  const Folder folder("render_film_fails");
  fake_ffmpeg(folder, "echo no such encoder >&2\nexit 1\n");
  const std::string scene = write_scene(folder, sphere_with({{"every", "5 us"}, {"movie", "mp4"}}));
  const Result result =
      run_program({"run", scene, "--out", folder.file("out")}, with("PATH=" + folder.path()));
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_NE(result.err.find("no such encoder"), std::string::npos) << result.err;
  EXPECT_TRUE(std::filesystem::exists(folder.file("out/render_000002.png")));
}

TEST(RenderRuns, ThePlanTellsThatNoFilmIsMade) {
  const Folder folder("render_no_film");
  const std::string scene = write_scene(folder, sphere_with({{"movie", "mp4"}}));
  const Result result = run_program({"plan", scene, "--json"}, with("PATH=/nowhere"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(json::parse(result.out)["warnings"].dump().find("ffmpeg"), std::string::npos);
}

}  // namespace render_test
}  // namespace hyperlattice::test
