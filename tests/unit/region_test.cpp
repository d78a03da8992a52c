// Solids and sets of solids: the points inside, boxes, anchors and areas.
#include <geometry/primitives.hpp>
#include <geometry/region.hpp>

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace region_test {
using namespace hyperlattice;

using Values = std::initializer_list<std::pair<std::string_view, std::vector<double>>>;

/// Fills the options of a primitive from one list of SI numbers for each option, and calls `use`
/// with them.
template <class Use>
auto with_options(std::string_view name, Values values, Use use) {
  for (const Primitive& primitive : primitives()) {
    if (primitive.name != name) continue;
    const Complaint silent{nullptr, [](void*, std::string_view) noexcept {}};
    const std::unique_ptr<void, void (*)(void*)> options(primitive.options.create(silent),
                                                         primitive.options.destroy);
    for (const auto& [key, numbers] : values)
      for (const Option& option : primitive.options.options)
        if (option.name == key) {
          OptionValue value;
          value.number = numbers[0];
          value.numbers = numbers;
          option.set(options.get(), value, silent);
        }
    return use(primitive, options.get());
  }
  throw std::logic_error("no such primitive");
}

std::shared_ptr<const Region> make(std::string_view name, Values values) {
  return with_options(
      name, values,
      [](const Primitive& primitive, const void* options) -> std::shared_ptr<const Region> {
        return std::make_shared<Region>(primitive.make(options));
      });
}

/// The options that the cross-field check refuses.
std::vector<std::string> faults_of(std::string_view name, Values values) {
  return with_options(name, values, [](const Primitive& primitive, const void* options) {
    std::vector<std::string> found;
    const FaultSink faults{&found,
                           [](void* self, std::string_view option, std::string_view) noexcept {
                             static_cast<std::vector<std::string>*>(self)->emplace_back(option);
                           }};
    const Complaint none{
        nullptr, [](void*, std::string_view sentence) noexcept { ADD_FAILURE() << sentence; }};
    EXPECT_TRUE(primitive.options.check(options, faults, none));
    return found;
  });
}

std::shared_ptr<const Region> box(Vec3 low, Vec3 high) {
  return make("box", {{"low", {low.x, low.y, low.z}}, {"high", {high.x, high.y, high.z}}});
}

/// Volume of a solid in a box, estimated with the points of a regular grid.
double volume(const Region& region, Vec3 low, Vec3 high, int n) {
  const Vec3 cell = (1.0 / n) * (high - low);
  std::uint64_t count = 0;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        count += region.contains(
            {low.x + (i + 0.5) * cell.x, low.y + (j + 0.5) * cell.y, low.z + (k + 0.5) * cell.z});
  return static_cast<double>(count) * cell.x * cell.y * cell.z;
}

TEST(Region, HollowSphereOfThePaperHoldsItsParticles) {
  const auto sphere = make("hollow_sphere", {{"inner_radius", {0.020}}, {"outer_radius", {0.050}}});
  std::uint64_t count = 0;
  for (int k = -60; k < 60; ++k)
    for (int j = -60; j < 60; ++j)
      for (int i = -60; i < 60; ++i)
        count += sphere->contains(sphere->anchor + 0.001 * Vec3{i + 0.5, j + 0.5, k + 0.5});
  EXPECT_EQ(count, 490'432u);
}

TEST(Region, VolumesFollowTheClosedForms) {
  const double pi = std::numbers::pi;
  const Vec3 low{-3, -3, -3}, high{3, 3, 3};
  EXPECT_NEAR(volume(*make("sphere", {{"centre", {0.5, 0, 0}}, {"radius", {2}}}), low, high, 120),
              4 * pi / 3 * 8, 0.05);
  EXPECT_NEAR(volume(*make("hollow_sphere", {{"inner_radius", {1}}, {"outer_radius", {2}}}), low,
                     high, 120),
              4 * pi / 3 * 7, 0.05);
  EXPECT_NEAR(
      volume(*make("cylinder", {{"start", {-1, -1, -1}}, {"end", {1, 1, 1}}, {"radius", {0.5}}}),
             low, high, 120),
      pi * 0.25 * 2 * std::sqrt(3.0), 0.05);
  EXPECT_NEAR(volume(*make("box", {{"centre", {0, 0, 0}}, {"size", {1, 2, 3}}}), low, high, 120), 6,
              1e-9);
  EXPECT_NEAR(
      volume(*make("half_space", {{"point", {0, 0, 0}}, {"normal", {1, 1, 0}}}), low, high, 120),
      108, 1);
}

TEST(Region, NothingOfASolidLiesOutsideItsBox) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-3, 3);
  const std::shared_ptr<const Region> solids[] = {
      make("sphere", {{"centre", {0.5, 0.2, -1}}, {"radius", {1}}}),
      make("cylinder", {{"start", {-1, -1, -1}}, {"end", {1, 0.5, 0}}, {"radius", {0.7}}}),
      make("half_space", {{"point", {0.3, 0, 0}}, {"normal", {-2, 0, 0}}}),
      make_set(Region::Kind::set_union, {box({0, 0, 0}, {1, 1, 1}), box({-2, -1, 0}, {-1, 2, 2})}),
      make_set(Region::Kind::intersection,
               {box({-1, -1, -1}, {1, 1, 1}),
                make("sphere", {{"centre", {1, 1, 1}}, {"radius", {1.5}}})})};
  for (const auto& solid : solids) {
    int inside = 0;
    for (int n = 0; n < 20'000; ++n) {
      const Vec3 p{coordinate(random), coordinate(random), coordinate(random)};
      if (!solid->contains(p)) continue;
      ++inside;
      EXPECT_TRUE(solid->low.x <= p.x && p.x <= solid->high.x && solid->low.y <= p.y &&
                  p.y <= solid->high.y && solid->low.z <= p.z && p.z <= solid->high.z);
    }
    EXPECT_GT(inside, 0);
  }
}

TEST(Region, CylindersBoxTouchesItsRims) {
  const auto cylinder =
      make("cylinder", {{"start", {0, 0, 0}}, {"end", {3, 4, 0}}, {"radius", {0.5}}});
  EXPECT_NEAR(cylinder->low.x, -0.5 * 0.8, 1e-12);  // the rims are normal to the axis (0.6, 0.8, 0)
  EXPECT_NEAR(cylinder->high.y, 4 + 0.5 * 0.6, 1e-12);
  EXPECT_NEAR(cylinder->high.z, 0.5, 1e-12);
}

TEST(Region, BoundaryCountsAsInside) {
  EXPECT_TRUE(make("sphere", {{"radius", {2}}})->contains({2, 0, 0}));
  EXPECT_TRUE(
      make("hollow_sphere", {{"inner_radius", {1}}, {"outer_radius", {2}}})->contains({0, 1, 0}));
  EXPECT_TRUE(box({0, 0, 0}, {1, 1, 1})->contains({1, 0, 1}));
  EXPECT_TRUE(make("half_space", {{"normal", {0, 0, 1}}})->contains({5, 5, 0}));
  for (const double length : {1e-300, 1e308}) {
    const auto half = make("half_space", {{"normal", {length, length, length}}});
    EXPECT_TRUE(half->contains({-5e3, 1, 1})) << length;
    EXPECT_FALSE(half->contains({5e3, 1, 1})) << length;
  }
  EXPECT_FALSE(make("half_space", {{"normal", {0, 0, 1}}})->contains({5, 5, 1e-12}));
}

TEST(Region, SetsFollowTheAlgebraOfSets) {
  const auto a = make("sphere", {{"radius", {1}}}), b = box({0, 0, 0}, {2, 2, 2});
  const auto either = make_set(Region::Kind::set_union, {a, b}),
             both = make_set(Region::Kind::intersection, {a, b}),
             rest = make_set(Region::Kind::difference, {a, b});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-2, 2);
  for (int n = 0; n < 10'000; ++n) {
    const Vec3 p{coordinate(random), coordinate(random), coordinate(random)};
    EXPECT_EQ(either->contains(p), a->contains(p) || b->contains(p));
    EXPECT_EQ(both->contains(p), a->contains(p) && b->contains(p));
    EXPECT_EQ(rest->contains(p), a->contains(p) && !b->contains(p));
  }
}

TEST(Region, AnchorsPutWholeCellsIntoTheShape) {
  EXPECT_EQ(make("sphere", {{"centre", {1, 2, 3}}, {"radius", {1}}})->anchor, (Vec3{1, 2, 3}));
  EXPECT_EQ(box({1, 2, 3}, {4, 5, 6})->anchor, (Vec3{1, 2, 3}));
  EXPECT_EQ(
      make_set(Region::Kind::set_union, {box({1, 2, 3}, {4, 5, 6}), box({0, 0, 0}, {1, 1, 1})})
          ->anchor,
      (Vec3{1, 2, 3}));
  const auto upright =
      make("cylinder", {{"start", {0, 0, 0}}, {"end", {0, 0, 5}}, {"radius", {1}}});
  int along = 0;
  for (int k = -10; k < 10; ++k) along += upright->contains(upright->anchor + Vec3{0, 0, k + 0.5});
  EXPECT_EQ(along, 5);
}

TEST(Region, TrueAreas) {
  const double pi = std::numbers::pi;
  EXPECT_DOUBLE_EQ(make("sphere", {{"radius", {0.5}}})->outer_area, pi);
  EXPECT_DOUBLE_EQ(make("sphere", {{"radius", {0.5}}})->inner_area, 0);
  const auto hollow = make("hollow_sphere", {{"inner_radius", {1}}, {"outer_radius", {2}}});
  EXPECT_DOUBLE_EQ(hollow->inner_area, 4 * pi);
  EXPECT_DOUBLE_EQ(hollow->outer_area, 16 * pi);
  EXPECT_DOUBLE_EQ(box({0, 0, 0}, {1, 2, 3})->outer_area, 22);
  EXPECT_EQ(make_set(Region::Kind::set_union, {hollow, hollow})->outer_area, 0);
}

TEST(Region, OnlySetsOfSolidsAreSolid) {
  const auto ball = make("sphere", {{"radius", {1}}});
  EXPECT_TRUE(make_set(Region::Kind::set_union, {ball, ball})->is_solid());
  EXPECT_FALSE(
      make_set(Region::Kind::intersection, {ball, built_in_region("surface")})->is_solid());
  EXPECT_FALSE(built_in_region("all")->is_solid());
}

TEST(Region, PartsThatDoNotMeetGiveAnInvertedBox) {
  const auto apart =
      make_set(Region::Kind::intersection, {box({0, 0, 0}, {1, 1, 1}), box({2, 0, 0}, {3, 1, 1})});
  EXPECT_GT(apart->low.x, apart->high.x);
}

TEST(Region, SixHalfSpacesAreBounded) {
  std::vector<std::shared_ptr<const Region>> parts;
  for (const double side : {-1.0, 1.0})
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      const Vec3 n = side * axis;
      parts.push_back(make("half_space",
                           {{"point", {2 * n.x, 2 * n.y, 2 * n.z}}, {"normal", {n.x, n.y, n.z}}}));
    }
  const auto cube = make_set(Region::Kind::intersection, parts);
  EXPECT_EQ(cube->low, (Vec3{-2, -2, -2}));
  EXPECT_EQ(cube->high, (Vec3{2, 2, 2}));
}

TEST(Region, BuiltInNames) {
  for (const std::string& name : built_in_region_names())
    EXPECT_NE(built_in_region(name), nullptr) << name;
  EXPECT_EQ(built_in_region_names().size(), 10u);
  EXPECT_EQ(built_in_region("z_max")->direction, 5);
  EXPECT_EQ(built_in_region("z_maxx"), nullptr);
}

TEST(Regions, KeepNamesIndicesAndShapes) {
  Regions regions;
  EXPECT_EQ(regions[RegionId{0}].kind, Region::Kind::all);
  const auto ball = make("sphere", {{"radius", {1}}});
  const RegionId id = regions.add(ball, "ball");
  EXPECT_EQ(regions.find("ball")->index, id.index);
  EXPECT_FALSE(regions.find("bal"));
  const Shape* shape = regions.shape(ball);
  for (int n = 0; n < 100; ++n) regions.shape(ball);  // earlier shapes keep their address
  EXPECT_TRUE(shape->contains({0, 0, 1}));
  EXPECT_FALSE(shape->contains({0, 0, 1.001}));
  EXPECT_EQ(shape->low, (Vec3{-1, -1, -1}));
}

TEST(Primitives, CrossChecksNameTheOption) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(faults_of("hollow_sphere", {{"inner_radius", {2}}, {"outer_radius", {1}}}),
            Names{"outer_radius"});
  EXPECT_EQ(faults_of("hollow_sphere", {{"inner_radius", {1}}, {"outer_radius", {2}}}), Names{});
  EXPECT_EQ(faults_of("box", {{"low", {0, 0, 0}}, {"high", {1, 0, 1}}}), Names{"high"});
  EXPECT_EQ(faults_of("box", {{"low", {0, 0, 0}}, {"size", {1, 1, 1}}}), Names{"size"});
  EXPECT_EQ(faults_of("box", {{"low", {0, 0, 0}}}), Names{""});
  EXPECT_EQ(faults_of("half_space", {{"normal", {0, 0, 0}}}), Names{"normal"});
  EXPECT_EQ(faults_of("cylinder", {{"start", {1, 0, 0}}, {"end", {1, 0, 0}}}), Names{"end"});
}

}  // namespace region_test
