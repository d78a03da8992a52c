// Pictures of small bodies against their geometry: the place and colour of each particle, and which
// particles hide others.
#include <support/output.hpp>
#include <support/png.hpp>

#include <gtest/gtest.h>

namespace hyperlattice::test {
namespace picture_test {

/// The area of a colour, without the legend at the foot and the time at the top.
struct Patch {
  int count = 0, left = 1 << 30, right = -1, top = 1 << 30, bottom = -1;
  int width() const { return right - left + 1; }
  int height() const { return bottom - top + 1; }
};

enum Hue { red, green, blue };

Patch find(const Pixels& pixels, Hue hue) {
  Patch patch;
  for (int y = pixels.height / 16; y < pixels.height * 9 / 10; ++y)
    for (int x = 0; x < pixels.width; ++x) {
      const png_byte* p = pixels.at(x, y);
      if (p[hue] < p[(hue + 1) % 3] + 40 || p[hue] < p[(hue + 2) % 3] + 40) continue;
      ++patch.count;
      patch.left = std::min(patch.left, x);
      patch.right = std::max(patch.right, x);
      patch.top = std::min(patch.top, y);
      patch.bottom = std::max(patch.bottom, y);
    }
  return patch;
}

/// Every third particle of a block is in the region "some". The test sets the broken springs.
struct Scene {
  FakeBody body;
  Folder folder{"picture"};

  explicit Scene(std::array<int, 3> counts) : body(counts) {}
  Pixels draw(const nlohmann::json& options, const std::function<void(FakeBody&)>& change,
              double time = 0) {
    Plugin writer("writers.picture", options);
    writer.begin(body.context(folder.path()));
    const Snapshot snapshot = body.at(time);
    body.open.assign(body.open.size(), 0);
    body.closed.assign(body.open.size(), 0);
    change(body);
    writer.frame(snapshot);
    writer.end();
    return read_png(folder.file("picture_000000.png"));
  }
};

TEST(Picture, ShowsACubeAsASquareInTheMiddle) {
  Scene scene({1, 1, 1});
  const Pixels pixels =
      scene.draw({{"view", {1, 0, 0}}, {"width", 400}, {"height", 300}}, [](FakeBody&) {});
  ASSERT_EQ(pixels.width, 400);
  ASSERT_EQ(pixels.height, 300);
  const Patch patch = find(pixels, blue);
  EXPECT_NEAR(patch.width(), patch.height(), 1);
  EXPECT_GT(patch.width(), 200);  // the cube fills the frame
  EXPECT_NEAR(patch.left + patch.right, 399, 2);
  EXPECT_EQ(patch.count, patch.width() * patch.height());
  EXPECT_EQ(find(pixels, red).count + find(pixels, green).count, 0);
  for (const int x : {0, 399})
    for (int channel = 0; channel < 3; ++channel) EXPECT_EQ(pixels.at(x, 150)[channel], 255);
}

TEST(Picture, ShowsASphereAsADisc) {
  Scene scene({1, 1, 1});
  const Pixels pixels =
      scene.draw({{"particles", "spheres"}, {"width", 400}, {"height", 400}}, [](FakeBody&) {});
  const Patch patch = find(pixels, blue);
  EXPECT_NEAR(patch.width(), patch.height(), 3);  // the rim of the disc is too dark to count
  const double radius = 0.5 * patch.width();
  EXPECT_NEAR(patch.count, 3.14159265 * radius * radius, 0.02 * patch.count);
}

TEST(Picture, ColoursByFailure) {
  Scene scene({3, 1, 1});  // the view is from -y, so that x points right
  const Pixels pixels =
      scene.draw({{"view", {0, -1, 0}}, {"width", 300}, {"height", 300}}, [](FakeBody& body) {
        body.open = {2, 0, 0};
        body.closed = {1, 3, 0};  // one open failure outweighs any number of closed ones
      });
  const Patch r = find(pixels, red), g = find(pixels, green), b = find(pixels, blue);
  EXPECT_GT(r.count, 0);
  EXPECT_NEAR(r.count, g.count, 0.05 * r.count);
  EXPECT_NEAR(r.count, b.count, 0.05 * r.count);
  EXPECT_LT(r.right, g.left);
  EXPECT_LT(g.right, b.left);
}

TEST(Picture, NearParticlesHideFarOnes) {
  for (const char* camera : {"orthographic", "perspective"})
    for (const char* particles : {"cubes", "spheres"}) {
      Scene scene({2, 1, 1});
      const auto from = [&](double x) {
        return scene.draw({{"view", {x, 0, 0}},
                           {"camera", camera},
                           {"particles", particles},
                           {"width", 200},
                           {"height", 200}},
                          [](FakeBody& body) {
                            body.open = {1, 0};
                          });
      };
      EXPECT_EQ(find(from(1), red).count, 0) << camera << particles;
      EXPECT_GT(find(from(1), blue).count, 0) << camera << particles;
      EXPECT_EQ(find(from(-1), blue).count, 0) << camera << particles;
      EXPECT_GT(find(from(-1), red).count, 0) << camera << particles;
    }
}

TEST(Picture, ACutShowsTheInside) {
  Scene scene({3, 3, 3});
  const auto break_the_middle = [](FakeBody& body) { body.open[13] = 1; };
  const nlohmann::json whole{{"width", 200}, {"height", 200}, {"view", {0, -1, 0}}};
  EXPECT_EQ(find(scene.draw(whole, break_the_middle), red).count, 0);
  nlohmann::json cut = whole;
  // The cut removes particles 1, 4, 7 ...: a plane across the middle, x = 1.5 mm, and with it the
  // middle particle 13.
  cut["cut"] = "some";
  const Pixels open = scene.draw(cut, [](FakeBody& body) { body.open[12] = body.open[14] = 1; });
  const Patch walls = find(open, red);
  EXPECT_EQ(walls.count, 0);  // the walls of the slit are seen edge on
  cut["view"] = {1, -2, 0};
  EXPECT_GT(
      find(scene.draw(cut, [](FakeBody& body) { body.open[12] = body.open[9] = 1; }), red).count,
      0);
}

TEST(Picture, MagnifiesDisplacements) {
  Scene scene({3, 1, 1});  // u_x = t (x - c) + t^2 y, c = 1 mm
  const nlohmann::json options{{"view", {0, -1, 0}}, {"width", 400}, {"height", 400}};
  const auto centre_of_red = [&](double scale) {
    nlohmann::json scaled = options;
    scaled["scale"] = scale;
    const Patch patch = find(scene.draw(
                                 scaled,
                                 [](FakeBody& body) {
                                   body.open = {0, 1, 0};
                                 },
                                 0.1),
                             red);
    return 0.5 * (patch.left + patch.right);
  };
  const Patch all =
      find(scene.draw({{"view", {0, -1, 0}}, {"width", 400}, {"height", 400}, {"scale", 0}},
                      [](FakeBody&) {}),
           blue);
  const double spacing = all.width() / 3.0;            // pixels
  const double displacement = 0.1 * 0.5 + 0.01 * 0.5;  // middle particle, spacings
  EXPECT_NEAR(centre_of_red(0), 0.5 * (all.left + all.right), 1);
  EXPECT_NEAR(centre_of_red(5), 0.5 * (all.left + all.right) + 5 * displacement * spacing, 2);
}

TEST(Picture, ColoursByAField) {
  Scene scene({5, 1, 1});  // velocity_x grows along x: dark violet at the left, yellow at the right
  const Pixels pixels = scene.draw(
      {{"colour_by", "velocity_x"}, {"view", {0, -1, 0}}, {"width", 500}, {"height", 300}},
      [](FakeBody&) {});
  int row = 0;
  for (int y = 30; y < 250 && row == 0; ++y)
    if (pixels.at(250, y)[0] < 250) row = y + 5;
  const png_byte* left = pixels.at(60, row);
  const png_byte* right = pixels.at(440, row);
  EXPECT_GT(left[2], left[1] + 40);    // violet
  EXPECT_GT(right[1], right[2] + 80);  // yellow
  EXPECT_GT(right[0], right[2] + 80);
}

TEST(Picture, ShowsParticlesWithoutAValueGrey) {
  Scene scene({5, 1, 1});
  const Pixels pixels = scene.draw(
      {{"colour_by", "velocity_x"}, {"view", {0, -1, 0}}, {"width", 500}, {"height", 300}},
      [](FakeBody& body) { body.velocities[0] = std::numeric_limits<double>::quiet_NaN(); });
  const png_byte* left = pixels.at(60, 150);
  const png_byte* right = pixels.at(440, 150);
  EXPECT_EQ(left[0], left[1]);
  EXPECT_EQ(left[1], left[2]);
  EXPECT_LT(left[0], 250);             // not the background
  EXPECT_GT(right[1], right[2] + 80);  // yellow
}

TEST(Picture, TellsWhatItShows) {
  Scene scene({2, 2, 2});
  scene.draw(
      {{"colour_by", "displacement"}, {"range", {0.0, 2.5e-3}}}, [](FakeBody&) {}, 1e-6);
  const std::string bytes = contents(scene.folder.file("picture_000000.png"));
  for (const char* note : {"a fake body", "displacement magnitude (m) from 0 to 0.0025", "1e-06 s"})
    EXPECT_NE(bytes.find(note), std::string::npos) << note;
}

TEST(Picture, RefusesWhatItCannotDraw) {
  const auto faults =
      Plugin("writers.picture", {{"file", ""}, {"view", {0, 0, 0}}, {"range", {2, 1}}}).faults();
  EXPECT_EQ(faults, (std::vector<std::string>{"file: a name of letters, digits, '_', '-' and '.', "
                                              "without folders, of at most 80 characters",
                                              "view: a direction that is not zero",
                                              "range: two numbers, the smaller first"}));
  Scene scene({2, 2, 2});
  const auto message = [&](const nlohmann::json& options) -> std::string {
    try {
      scene.draw(options, [](FakeBody&) {});
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message({{"cut", "all"}}), "the cut takes every particle away");
  EXPECT_EQ(message({{"colour_by", "damage"}}),
            "this run has no field \"damage\"; it has displacement, velocity, broken_open, "
            "broken_closed");
  EXPECT_EQ(scene.folder.names(), std::vector<std::string>{});
}

TEST(Picture, FollowsABodyThatMovesIfAsked) {
  for (const char* fit : {"rest", "frame"}) {
    Scene scene({4, 1, 1});
    const Pixels pixels = scene.draw(
        {{"view", {0, -1, 0}}, {"fit", fit}, {"width", 300}, {"height", 300}}, [](FakeBody& body) {
          for (std::size_t n = 0; n < body.displacements.size(); n += 3)
            body.displacements[n] = 1;  // many times the length of the body
        });
    EXPECT_EQ(find(pixels, blue).count > 500, std::string(fit) == "frame") << fit;
  }
}

TEST(Picture, SurvivesParticlesThatFlewAway) {
  Scene scene({3, 3, 3});
  for (const char* camera : {"orthographic", "perspective"})
    for (const double where : {1e3, -1e3, 1e30, -1e30, std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::quiet_NaN()}) {
      const Pixels pixels =
          scene.draw({{"camera", camera}, {"width", 100}, {"height", 100}}, [&](FakeBody& body) {
            for (std::size_t n = 0; n < 3; ++n) body.displacements[n] = where;
          });
      EXPECT_GT(find(pixels, blue).count, 500) << camera << where;
    }
}

}  // namespace picture_test
}  // namespace hyperlattice::test
