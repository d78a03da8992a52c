// Voxel images of a ball and of a body with two phases, against closed forms and against the same
// bodies made of primitives.
#include <geometry/voxel_image.hpp>
#include <support/models.hpp>
#include <support/output.hpp>

#include <gtest/gtest.h>

#include <numbers>

namespace voxels_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

constexpr int across = 24;
constexpr double radius = 9;  // voxels

/// Voxels are 7 inside the ball and 1 outside; x runs fastest.
std::string ball_image(unsigned char outside = 1) {
  std::string bytes;
  for (int k = 0; k < across; ++k)
    for (int j = 0; j < across; ++j)
      for (int i = 0; i < across; ++i) {
        const auto from_middle = [](int n) { return n + 0.5 - across / 2.0; };
        const double square =
            std::pow(from_middle(i), 2) + std::pow(from_middle(j), 2) + std::pow(from_middle(k), 2);
        bytes += static_cast<char>(square <= radius * radius ? 7 : outside);
      }
  return bytes;
}

/// An image in its own file.
class Image {
 public:
  explicit Image(const std::string& bytes) : folder_("voxels") {
    std::ofstream(file(), std::ios::binary) << bytes;
  }
  std::string file() const { return folder_.file("image.raw"); }
  /// A region of the image, with `more` keys.
  std::string region(const std::string& more = R"("values": [7])", int n = across) const {
    const std::string count = std::to_string(n);
    return R"({ "voxels": { "file": ")" + file() + R"(", "counts": [)" + count + ", " + count +
           ", " + count + R"(], "voxel": 1)" + (more.empty() ? "" : ", " + more) + " } }";
  }

 private:
  Folder folder_;
};

std::string lattice(const std::string& shape, double spacing = 1, const std::string& more = "") {
  return R"({ "type": "lattices.cubic", "spacing": )" + std::to_string(spacing) + R"(, "shape": )" +
         shape + more + " }";
}

std::string sphere() {
  const std::string c = std::to_string(across / 2);
  return R"({ "sphere": { "radius": )" + std::to_string(radius) + R"(, "centre": [)" + c + ", " +
         c + ", " + c + "] } }";
}

std::vector<Vec3> places(const Body& body) {
  std::vector<Vec3> all;
  for (Particle p = 0; p < body.particles; ++p) all.push_back(body.position(p));
  return all;
}

TEST(Voxels, ABallIsTheBallMadeByAShape) {
  const Image image(ball_image());
  for (const char* boundary : {R"(, "boundary": "particles")", R"(, "boundary": "cells")"}) {
    const BuiltScene of_image = build(lattice(image.region(), 1, boundary) + ", " + elastic());
    const BuiltScene of_shape = build(lattice(sphere(), 1, boundary) + ", " + elastic());
    EXPECT_EQ(places(of_image->body), places(of_shape->body)) << boundary;
  }
  const double volume =
      static_cast<double>(build(lattice(image.region()) + ", " + elastic())->body.particles);
  EXPECT_NEAR(volume / (4 * std::numbers::pi / 3 * std::pow(radius, 3)), 1, 0.02);
}

TEST(Voxels, FinerAndCoarserLatticesTakeTheVoxelAtTheCellsCentre) {
  const Image image(ball_image());
  const auto particles = [&](double spacing) {
    return build(lattice(image.region(), spacing) + ", " + elastic())->body.particles;
  };
  EXPECT_EQ(particles(0.5), 8 * particles(1));
  EXPECT_NEAR(static_cast<double>(8 * particles(2)) / static_cast<double>(particles(1)), 1, 0.1);
}

TEST(Voxels, APhaseIsTheRegionOfItsValue) {
  const Image image(ball_image());
  const std::string box = R"({ "box": { "low": [0, 0, 0], "high": [24, 24, 24] } })";
  const auto two_phases = [&](const std::string& body, const std::string& phase) {
    return build(lattice(body) + ", " + elastic() + ", " +
                 elastic(R"("poisson": 0.25, "region": )" + phase));
  };
  const BuiltScene of_image = two_phases(image.region(""), image.region()),
                   of_shape = two_phases(box, sphere());
  ASSERT_EQ(of_image->body.particles, 24u * 24u * 24u);
  EXPECT_TRUE(of_image->kinds.material_of == of_shape->kinds.material_of);
  std::uint64_t inside = 0;
  for (Particle p = 0; p < of_image->body.particles; ++p)
    inside += of_image->kinds.material_of[p] == 1 ? 1 : 0;
  EXPECT_NEAR(static_cast<double>(inside) / static_cast<double>(of_image->body.particles),
              4 * std::numbers::pi / 3 * std::pow(radius / across, 3), 0.005);
}

TEST(Voxels, CellsHaveThePhaseOfTheirOwnVoxel) {
  const Image image(ball_image());
  const BuiltScene built =
      build(lattice(image.region(""), 1, R"(, "boundary": "cells")") + ", " + elastic() + ", " +
            elastic(R"("poisson": 0.25, "region": )" + image.region()));
  double mass = 0;
  for (Particle p = 0; p < built->body.particles; ++p) mass += built->mass(p);
  EXPECT_NEAR(mass, 24 * 24 * 24 * built->materials[0].mass, 1e-9 * mass);
  EXPECT_GT(built->kinds.mixtures.count(), 2u);
}

TEST(Voxels, ValuesLeftOutAreAllButZero) {
  const Image image(ball_image(0));
  EXPECT_EQ(places(build(lattice(image.region("")) + ", " + elastic())->body),
            places(build(lattice(image.region()) + ", " + elastic())->body));
}

TEST(Voxels, XRunsFastestAndTwoBytesAreLittleEndian) {
  const std::string bytes("\x00\x00\x01\x02\x00\x00\x00\x00\x00\x00\x00\x00",
                          12);  // 3 x 2 x 1 voxels; the second is 513
  const VoxelSet set(bytes, {3, 2, 1}, VoxelType::uint16, {513}, {10, 20, 30}, 2);
  EXPECT_EQ(set.low(), (Vec3{12, 20, 30}));
  EXPECT_EQ(set.high(), (Vec3{14, 22, 32}));
  EXPECT_TRUE(set.contains({13, 21, 31}));
  EXPECT_TRUE(set.contains({12, 20, 30}));  // a voxel contains its lower corner
  EXPECT_FALSE(set.contains({12, 22, 30}));
  EXPECT_TRUE(set.contains({12, 20, 32}));  // the upper end of the image counts as inside
  EXPECT_FALSE(set.contains({11, 21, 31}));
  EXPECT_FALSE(set.contains({13, 23, 31}));
  EXPECT_FALSE(set.contains({infinity, 0, 0}));
}

TEST(Voxels, SaysWhatIsWrongWithAnImage) {
  const Image image(ball_image());
  const auto faults = [&](const std::string& more, int n = across) {
    return faults_of(lattice(image.region(more, n)) + ", " + elastic());
  };
  const auto expect = [](const std::string& text, const std::string& at, const std::string& part) {
    EXPECT_NE(text.find("/pipeline/0/shape/voxels/" + at), std::string::npos) << text;
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  expect(faults("", 25), "file",
         "25 x 25 x 25 voxels of 1 byte need 15625 bytes, and it has 13824");
  expect(faults(R"("type": "uint16")"), "file",
         "need 27648 bytes, and it has 13824; its size is that of uint8");
  expect(faults(R"("values": [7, 9])"), "file",
         "no voxel has the value 9; there are 1 (10712 voxels), 7 (3112 voxels)");
  expect(faults(R"("values": [256])"), "values", "whole numbers from 0 to 255");
  expect(faults(R"("low": [0, 0])"), "low", "");
  const auto scene_of = [](const std::string& file, const std::string& counts) {
    return lattice(R"({ "voxels": { "file": ")" + file + R"(", "counts": )" + counts +
                   R"(, "voxel": 1 } })") +
           ", " + elastic();
  };
  expect(faults_of(scene_of("no_such.raw", "[2, 2, 2]")), "file", "there is no such file");
  expect(faults_of(scene_of(image.file(), "[2, 2.5, 2]")), "counts", "whole numbers of voxels");
}

TEST(Voxels, SaysWhatAHeaderMayBe) {
  const Image image(std::string(352, '\0') + ball_image());
  const std::string why = faults_of(lattice(image.region()) + ", " + elastic());
  EXPECT_NE(why.find("it has 14176; if it begins with a header of 352 bytes, cut that off"),
            std::string::npos)
      << why;
}

}  // namespace voxels_test
