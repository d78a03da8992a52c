// Cuts of lattices: which springs each kind of surface takes away, against a direct search among
// all springs; the side of particles on a surface; faults.
#include <model/body_figures.hpp>
#include <model/build.hpp>
#include <support/cuts.hpp>
#include <support/models.hpp>

#include <gtest/gtest.h>

#include <set>

namespace cut_surface_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

using Ends = std::set<std::pair<Particle, Particle>>;

/// The ends of all springs of a body.
Ends springs_of(const Body& body) {
  Ends ends;
  body.for_springs([&](Particle a, Particle b, std::uint32_t) { ends.emplace(a, b); });
  return ends;
}
Ends cut_springs_of(const Body& body) {
  Ends ends;
  body.for_cut_springs([&](Particle a, Particle b, std::uint32_t) { ends.emplace(a, b); });
  return ends;
}

struct LatticeCase {
  const char* type;
  Keys more;
};
const LatticeCase lattices[] = {{"lattices.cubic", {}},
                                {"lattices.cubic", {{"boundary", "cells"}}},
                                {"lattices.bcc", {}},
                                {"lattices.fcc", {}},
                                {"lattices.random", {{"sample", 6}}}};

const Json shape = box({}, {6, 5, 4});

Json polygon(const Json& corners) { return {{"polygon", {{"corners", corners}}}}; }

BuiltScene cut_body(const LatticeCase& of, const Json& cuts, const Keys& material = {}) {
  return build(stage(of.type, Keys{{"spacing", 1}, {"shape", shape}, {"cuts", cuts}} + of.more) +
               elastic(material));
}

/// Checks that the body lacks the springs for which is_cut(x_a, x_b) holds, and no other.
template <class IsCut>
void expect_cut(const LatticeCase& of, const Json& cuts, const IsCut& is_cut) {
  const BuiltScene whole = cut_body(of, Json::array()), cut = cut_body(of, cuts);
  Ends there, gone;
  for (const auto& [a, b] : springs_of(whole->body))
    (is_cut(whole->body.position(a), whole->body.position(b)) ? gone : there).emplace(a, b);
  EXPECT_EQ(springs_of(cut->body), there) << of.type << cuts;
  EXPECT_EQ(cut_springs_of(cut->body), gone) << of.type << cuts;
  EXPECT_GT(gone.size(), 0U) << of.type << cuts;
  EXPECT_EQ(cut->body.cut_springs(), gone.size());
  EXPECT_EQ(cut->body.base_springs(), there.size());
  // Loads that ask for springs see the same.
  std::vector<Particle> all(cut->body.particles);
  for (Particle p = 0; p < all.size(); ++p) all[p] = p;
  EXPECT_EQ(springs_at(*cut, all).size(), there.size());
  // The constants of the material are those of the whole lattice.
  EXPECT_EQ(cut->materials[0].constants.base_stiffness,
            whole->materials[0].constants.base_stiffness);
}

/// The point where the line from a to b crosses a plane; nothing if it does not.
std::optional<Vec3> crossing(Vec3 a, Vec3 b, Vec3 point, Vec3 normal) {
  const double from = dot(a - point, normal), to = dot(b - point, normal);
  if ((from > 0) == (to > 0)) return std::nullopt;
  return a + from / (from - to) * (b - a);
}

/// Returns whether value < limit. No crossing may be so near to an outline that the rule of the rim
/// decides, of which the direct search knows nothing.
bool is_below(double value, double limit) {
  EXPECT_GT(std::abs(value - limit), 1e-5);
  return value < limit;
}

TEST(Cuts, PlanesAndDiscsInAnyDirectionOnEveryLattice) {
  const Vec3 point{2.93, 2.41, 1.87};
  for (const LatticeCase& of : lattices)
    for (const Vec3 normal : {Vec3{0, 0, 1}, Vec3{0, -2, 0}, Vec3{1, 0, 0}, Vec3{0.3, -0.7, 1.1}}) {
      expect_cut(of, Json::array({plane(point, normal)}),
                 [&](Vec3 a, Vec3 b) { return crossing(a, b, point, normal).has_value(); });
      expect_cut(of, Json::array({disc(point, normal, 1.61)}), [&](Vec3 a, Vec3 b) {
        const auto x = crossing(a, b, point, normal);
        return x && is_below(norm(*x - point), 1.61);
      });
    }
}

TEST(Cuts, OverlappingCutsCountOnce) {
  const Vec3 point{2.93, 2.41, 1.87}, other{3.13, 2.19, 1.87};
  const Json cuts = Json::array({disc(point, {0, 0, 1}, 1.5), disc(other, {0, 0, -1}, 1.5)});
  for (const LatticeCase& of : lattices)
    expect_cut(of, cuts, [&](Vec3 a, Vec3 b) {
      const auto x = crossing(a, b, point, {0, 0, 1});
      return x && (is_below(norm(*x - point), 1.5) || is_below(norm(*x - other), 1.5));
    });
}

TEST(Cuts, PolygonIsConcaveIfItsCornersSaySo) {
  // An L in the plane x = 2.87.
  const Json corners = {{2.87, 0.23, 0.31}, {2.87, 4.19, 0.31}, {2.87, 4.19, 1.73},
                        {2.87, 1.73, 1.73}, {2.87, 1.73, 3.61}, {2.87, 0.23, 3.61}};
  for (const LatticeCase& of : lattices)
    expect_cut(of, Json::array({polygon(corners)}), [&](Vec3 a, Vec3 b) {
      const auto x = crossing(a, b, {2.87, 0, 0}, {1, 0, 0});
      return x && is_below(0.23, x->y) && is_below(x->y, 4.19) && is_below(0.31, x->z) &&
             is_below(x->z, is_below(x->y, 1.73) ? 3.61 : 1.73);
    });
}

/// Surfaces half-way between two planes of particles, whose outlines pass through crossings. The
/// particles stand at whole numbers: upright springs cross at these, and the two of each diagonal
/// half-way between two of them.
TEST(Cuts, CrossingsOnTheRimCount) {
  const LatticeCase& cells = lattices[1];
  const auto count = [&](const Json& cut) {
    return cut_body(cells, Json::array({cut}))->body.cut_springs();
  };
  for (const double sign : {1.0, -1.0}) {
    const auto disc_of = [&](double radius) { return disc({3, 2, 1.5}, {0, 0, sign}, radius); };
    // One upright spring, then 4 x 2 diagonals, then four upright ones.
    EXPECT_EQ(count(disc_of(0.4999)), 1U);
    EXPECT_EQ(count(disc_of(0.5)), 9U);
    EXPECT_EQ(count(disc_of(0.9999)), 9U);
    EXPECT_EQ(count(disc_of(1)), 13U);
    EXPECT_EQ(count(disc_of(1.0001)), 13U);
    const auto square = [&](double half) {
      Json corners = Json::array();
      for (const Vec3 x :
           {Vec3{-half, -half, 0}, Vec3{half, -half, 0}, Vec3{half, half, 0}, Vec3{-half, half, 0}})
        corners.push_back(Vec3{3 + sign * x.x, 2 + x.y, 1.5});
      return polygon(corners);
    };
    // On the edges are 8 upright springs and 8 x 2 diagonals.
    EXPECT_EQ(count(square(0.9999)), 9U);
    EXPECT_EQ(count(square(1)), 33U);
    EXPECT_EQ(count(square(1.0001)), 33U);
  }
}

/// The edges between the facets of a sheet leave no gap. The move of the sheet decides on crossings
/// around it: it leads to those of larger x and y, and away from the others.
TEST(Cuts, CrossingsBetweenFacetsCount) {
  const auto count = [](double half) {
    const Vec3 a{3 - half, 2 - half, 1.5}, b{3 + half, 2 - half, 1.5}, c{3 + half, 2 + half, 1.5},
        d{3 - half, 2 + half, 1.5}, middle{3, 2, 1.5};
    const InputText file("fan.stl",
                         facets({{a, b, middle}, {b, c, middle}, {c, d, middle}, {d, a, middle}}));
    return cut_body(lattices[1], Json::array({Json{{"sheet", {{"file", file.path()}}}}}))
        ->body.cut_springs();
  };
  EXPECT_EQ(count(0.9999), 9U);
  EXPECT_EQ(count(1), 20U);
  EXPECT_EQ(count(1.0001), 33U);
}

TEST(Cuts, ListOfDiscsIsTheSumOfItsDiscs) {
  const InputText file("discs.csv",
                       "x,y,z,nx,ny,nz,radius\n293,241,187,0,0,2,150\n"
                       "200,301,110,1,1,0,120\n9000,0,0,1,0,0,1\n");
  const Vec3 one{2.93, 2.41, 1.87}, two{2, 3.01, 1.1};
  for (const LatticeCase& of : lattices) {
    const Json cuts = Json::array({Json{{"discs", {{"file", file.path()}, {"scale", "1 cm"}}}}});
    expect_cut(of, cuts, [&](Vec3 a, Vec3 b) {
      const auto x = crossing(a, b, one, {0, 0, 1}), y = crossing(a, b, two, {1, 1, 0});
      return (x && is_below(norm(*x - one), 1.5)) || (y && is_below(norm(*y - two), 1.2));
    });
    const BuiltScene cut = cut_body(of, cuts);
    const std::vector<std::string>& warnings = cut->warnings;
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_EQ(warnings[0], "1 of the 3 surfaces of /pipeline/0/cuts/0/discs cross no spring");
  }
}

/// A sheet that is bent along an edge, and passes through particles of the cubic lattice wherever
/// it can: the flat part at z = 1.5 for x < 3.5, the part at 45 degrees beyond.
TEST(Cuts, BentSheetThroughParticlesLeavesTwoBodies) {
  const Vec3 a{-1, -1, 1.5}, b{3.5, -1, 1.5}, c{3.5, 9, 1.5}, d{-1, 9, 1.5}, e{8.5, -1, 6.5},
      f{8.5, 9, 6.5};
  const InputText upwards("up.stl", facets({{a, b, c}, {a, c, d}, {b, e, f}, {b, f, c}}));
  const InputText downwards("down.stl", facets({{a, c, b}, {a, d, c}, {b, f, e}, {b, c, f}}));
  const auto height = [](Vec3 x) { return x.x < 3.5 ? x.z - 1.5 : x.z - 1.5 - (x.x - 3.5); };
  for (const LatticeCase& of : lattices)
    for (const InputText* file : {&upwards, &downwards}) {
      const double sign = file == &upwards ? 1 : -1;
      const Json cuts = Json::array({Json{{"sheet", {{"file", file->path()}}}}});
      // A particle on the sheet is on the side that the normal points away from.
      const auto is_beyond = [&](Vec3 x) { return sign * height(x) > 1e-9; };
      expect_cut(of, cuts, [&](Vec3 x, Vec3 y) {
        if (is_beyond(x) != is_beyond(y)) return true;
        // The line may cross both parts.
        const auto at_fold = crossing(x, y, {3.5, 0, 0}, {1, 0, 0});
        return at_fold && is_beyond(*at_fold) != is_beyond(x);
      });
      EXPECT_EQ(parts_of(cut_body(of, cuts)->body).count, 2U) << of.type << sign;
    }
}

/// A plane through particles: those on it are on the side that the normal points away from.
TEST(Cuts, ParticlesOnAPlaneAreBehindIt) {
  for (const LatticeCase& of : lattices) {
    if (std::string(of.type) == "lattices.random") continue;
    const BuiltScene whole = cut_body(of, Json::array());
    for (const Vec3 normal : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{1, 1, 0}, Vec3{-1, -1, -1}}) {
      const Vec3 through = whole->body.position(whole->body.particles / 2 + 3);
      const Json cuts = Json::array({plane(through, normal)});
      const BuiltScene cut = cut_body(of, cuts);
      std::uint64_t on = 0;
      const auto is_beyond = [&](Particle p) {
        const double height = dot(cut->body.position(p) - through, normal);
        on += std::abs(height) < 1e-9 ? 1 : 0;
        return height > 1e-9;
      };
      for (const auto& [a, b] : springs_of(cut->body)) EXPECT_EQ(is_beyond(a), is_beyond(b));
      for (const auto& [a, b] : cut_springs_of(cut->body)) EXPECT_NE(is_beyond(a), is_beyond(b));
      EXPECT_GT(on, 0U);
      EXPECT_EQ(cut->body.base_springs() + cut->body.cut_springs(), whole->body.base_springs());
      EXPECT_EQ(parts_of(cut->body).count, 2U);
    }
  }
}

TEST(Cuts, BorderSeparatesBodiesThatTouch) {
  const Json grain = {{"sphere", {{"centre", {3, 2.5, 2}}, {"radius", 1.7}}}};
  for (const LatticeCase& of : lattices)
    expect_cut(of, Json::array({Json{{"border", {{"of", grain}}}}}), [](Vec3 a, Vec3 b) {
      const Vec3 centre{3, 2.5, 2};
      return (norm(a - centre) <= 1.7) != (norm(b - centre) <= 1.7);
    });
}

TEST(Cuts, VolumetricEnergyEndsWithTheCellsThatAreCut) {
  const BuiltScene whole = cut_body(lattices[0], Json::array(), {{"poisson", 0.3}}),
                   cut = cut_body(lattices[0], Json::array({plane({3, 0, 0}, {1, 0, 0})}),
                                  {{"poisson", 0.3}});
  const auto cells = [](const Model& model) {
    int count = 0;
    model.volumetric.for_cells([&](Site, double) { ++count; });
    return count;
  };
  EXPECT_EQ(cells(*whole), 5 * 4 * 3);
  EXPECT_EQ(cells(*cut), 4 * 4 * 3);
}

TEST(Cuts, FaultsNameTheSurfaceAndWhatWasExpected) {
  const InputText none("none.csv", "x,y,z,nx,ny,nz,radius\n"),
      short_row("short.csv", "x,y,z,nx,ny,nz,radius\n1,2,3,0,0,1\n"),
      column("column.csv", "x,y,z,nx,ny,nz\n1,2,3,0,0,1\n"),
      normal("normal.csv", "x,y,z,nx,ny,nz,radius\n1,2,3,0,0,1,1\n1,2,3,0,0,0,1\n"),
      radius("radius.csv", "x,y,z,nx,ny,nz,radius\n1,2,3,0,0,1,-1\n"),
      word("word.csv", "x,y,z,nx,ny,nz,radius\n1,2,three,0,0,1,1\n"),
      solid("solid.stl", "solid\nendsolid\n");
  const auto file = [](const char* kind, const InputText& of) {
    return Json{{kind, {{"file", of.path()}}}};
  };
  struct Wrong {
    Json cut;
    const char *pointer, *expected;
  };
  const Wrong all[] = {
      {plane({9, 0, 0}, {1, 0, 0}), "/plane", "3.5 m away from the particles"},
      {plane({0, 0, 0}, {0, 0, 0}), "/plane/normal", "not zero"},
      {disc({3, 2, 2.2}, {0, 0, 1}, 0.3), "/disc", "passes between all of them: a larger one"},
      {disc({3, 2, 20}, {0, 0, 1}, 1), "/disc", "16.5 m away"},
      {disc({3, 2, 2}, {0, 0, 1}, 0), "/disc/radius", "above 0"},
      {polygon({{0, 0, 2}, {1, 0, 2}}), "/polygon/corners", "at least three corners"},
      {polygon({{0, 0, 2}, {1, 0, 2}, {2, 0, 2}}), "/polygon/corners", "no area"},
      {polygon({{0, 0, 2}, {4, 0, 2}, {4, 4, 3}, {0, 4, 2}}), "/polygon/corners", "off the plane"},
      {polygon({{0, 0, 2}, {4, 4, 2}, {4, 0, 2}, {0, 3, 2}}), "/polygon/corners", "cross"},
      {polygon({{0, 0, 2}, {"1 s", 0, 2}, {2, 1, 2}}), "/polygon/corners/1/0", "m"},
      {file("discs", none), "/discs/file", "it has no discs"},
      {file("discs", short_row), "/discs/file", "line 2: a row of 7 cells"},
      {file("discs", column), "/discs/file", "no column \"radius\""},
      {file("discs", normal), "/discs/file", "line 3: the normal is [0, 0, 0]"},
      {file("discs", radius), "/discs/file", "line 2: the radius is not above 0"},
      {file("discs", word), "/discs/file", "line 2: a number was expected in the column \"z\""},
      {file("sheet", solid), "/sheet/file", "no facets"},
      {{{"sheet", {{"file", "nowhere.stl"}}}}, "/sheet/file", "no such file"},
      {{{"border", {{"of", "all"}}}}, "/border", "holds all particles"},
      {{{"border", {{"of", box({9, 9, 9}, {10, 10, 10})}}}}, "/border", "holds none"},
      {{{"plain", {{"normal", {0, 0, 1}}}}}, "/plain", "did you mean \"plane\"?"},
      {3, "", "a surface: an object with one key"},
  };
  for (const Wrong& wrong : all) {
    std::string faults;
    try {
      cut_body(lattices[0], Json::array({wrong.cut}));
    } catch (const InputError& error) {
      ASSERT_EQ(error.faults().size(), 1U) << error.what();
      EXPECT_EQ(error.faults()[0].pointer, std::string("/pipeline/0/cuts/0") + wrong.pointer);
      faults = error.what();
    }
    EXPECT_NE(faults.find(wrong.expected), std::string::npos) << wrong.cut << faults;
  }
  for (const Json& away : {plane({9, 0, 0}, {1, 0, 0}), disc({3, 2, 20}, {0, 0, 1}, 1)}) {
    std::string faults;
    try {
      cut_body(lattices[4], Json::array({away}));
    } catch (const InputError& error) {
      faults = error.what();
    }
    EXPECT_NE(faults.find("m away from the particles"), std::string::npos) << away << faults;
  }
  EXPECT_NE(faults_of(stage("lattices.cubic", {{"spacing", 1}, {"shape", shape}, {"cuts", 3}}) +
                      elastic())
                .find("a list of surfaces"),
            std::string::npos);
}

}  // namespace cut_surface_test
