// STL solids: files that are read or refused, messages, and the points inside, against closed
// forms, also where a ray meets edges and corners.
#include <geometry/triangle_mesh.hpp>
#include <support/output.hpp>
#include <support/scenes.hpp>

#include <gtest/gtest.h>

#include <cstring>
#include <numbers>
#include <random>

namespace stl_test {
using namespace hyperlattice;
using Facets = std::vector<std::array<Vec3, 3>>;

std::string text_stl(const Facets& facets) {  // shifted to y + 10, numbers with a sign
  std::string text = "solid a name\n";
  for (const auto& facet : facets) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (const Vec3 p : facet)
      text += "      vertex " + std::to_string(p.x) + " +" + std::to_string(p.y + 10) + " " +
              std::to_string(p.z) + "\n";
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid a name\n";
}

std::string binary_stl(const Facets& facets) {
  std::string bytes(80, ' ');
  const auto append = [&](auto number) {
    char raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    bytes.append(raw, sizeof number);
  };
  append(static_cast<std::uint32_t>(facets.size()));
  for (const auto& facet : facets) {
    for (int n = 0; n < 3; ++n) append(0.0F);
    for (const Vec3 p : facet)
      for (const double c : {p.x, p.y, p.z}) append(static_cast<float>(c));
    append(std::uint16_t{0});
  }
  return bytes;
}

/// The quadrilateral a b c d, anticlockwise, as two facets.
void append_quad(Facets& facets, Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  facets.push_back({a, b, c});
  facets.push_back({a, c, d});
}

/// A prism over an anticlockwise polygon in the plane z = 0. The triangulation of the polygon is
/// given.
Facets prism(const std::vector<Vec3>& polygon, const std::vector<std::array<int, 3>>& triangles,
             double height) {
  const Vec3 up{0, 0, height};
  Facets facets;
  for (const auto& [a, b, c] : triangles) {
    const auto at = [&](int n) { return polygon[static_cast<std::size_t>(n)]; };
    facets.push_back({at(c), at(b), at(a)});
    facets.push_back({at(a) + up, at(b) + up, at(c) + up});
  }
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const Vec3 p = polygon[n], q = polygon[(n + 1) % polygon.size()];
    append_quad(facets, p, q, q + up, p + up);
  }
  return facets;
}

Facets l_bracket() {
  return prism({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}},
               {{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {3, 4, 5}}, 1);
}

bool in_l_bracket(Vec3 p) {
  return p.x > 0 && p.y > 0 && p.z > 0 && p.z < 1 && p.x < 2 && p.y < 2 && (p.x < 1 || p.y < 1);
}

/// Rotates a profile of points (radius, height) about z. Profiles that end on the axis give a ball,
/// closed profiles a ring.
Facets turned(const std::function<Vec3(int, int)>& point, int across, int around) {
  Facets facets;
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < around; ++j)
      append_quad(facets, point(i, j), point(i, (j + 1) % around), point(i + 1, (j + 1) % around),
                  point(i + 1, j));
  return facets;
}

Facets torus(double ring, double tube, int n) {
  return turned(
      [=](int i, int j) {
        const double a = 2 * std::numbers::pi * (i % n) / n, b = 2 * std::numbers::pi * j / n,
                     r = ring + tube * std::cos(a);
        return Vec3{r * std::cos(b), r * std::sin(b), tube * std::sin(a)};
      },
      n, n);
}

Facets ball(double radius, int n) {
  return turned(
      [=](int i, int j) {
        if (i == 0 || i == n)
          return Vec3{0, 0, i == 0 ? -radius : radius};  // exact, so that the facets meet
        const double a = std::numbers::pi * (static_cast<double>(i) / n - 0.5),
                     b = std::numbers::pi * j / n;
        return Vec3{radius * std::cos(a) * std::cos(b), radius * std::cos(a) * std::sin(b),
                    radius * std::sin(a)};
      },
      n, 2 * n);
}

Facets inverted(Facets facets) {
  for (auto& facet : facets) std::swap(facet[0], facet[1]);
  return facets;
}

Facets joined(Facets a, const Facets& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TriangleMesh mesh_of(const Facets& facets) { return read_stl(binary_stl(facets), 1); }

template <class Code>
std::string refusal(Code&& code) {
  try {
    code();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(Stl, TextAndBinarySayTheSame) {
  const TriangleMesh binary = mesh_of(l_bracket()), text = read_stl(text_stl(l_bracket()), 1e-3);
  EXPECT_EQ(binary.points.size(), 12u);
  EXPECT_EQ(binary.facets, text.facets);
  for (std::size_t n = 0; n < 12; ++n)
    EXPECT_NEAR(norm(1e-3 * (binary.points[n] + Vec3{0, 10, 0}) - text.points[n]), 0, 1e-15);
  std::string named = binary_stl(l_bracket());
  named.replace(0, 5, "solid");  // some programs begin binary files with this word
  EXPECT_EQ(read_stl(named, 1).facets, binary.facets);
}

TEST(Stl, ClosedSurfacesAreSolidsWithTheirAreas) {
  EXPECT_EQ(solid_fault(mesh_of(l_bracket())), "");
  EXPECT_NEAR(surface_areas(mesh_of(l_bracket())).outer, 2 * 3 + 8, 1e-6);
  EXPECT_EQ(surface_areas(mesh_of(l_bracket())).inner, 0);
  const TriangleMesh hollow = mesh_of(joined(ball(5, 40), inverted(ball(2, 40))));
  EXPECT_EQ(solid_fault(hollow), "");
  EXPECT_NEAR(surface_areas(hollow).outer, 100 * std::numbers::pi, 1);
  EXPECT_NEAR(surface_areas(hollow).inner, 16 * std::numbers::pi, 0.2);
  EXPECT_EQ(solid_fault(mesh_of(torus(3, 1, 24))), "");
}

TEST(Stl, RefusesWhatIsNoSolid) {
  Facets open = l_bracket();
  open.pop_back();
  EXPECT_EQ(solid_fault(mesh_of(open)),
            "the surface is open: no other facet shares the edge from (0, 2, 1) to (0, 0, 1) "
            "(metres) of facet 6");
  Facets one_turned = l_bracket();
  std::swap(one_turned[7][0], one_turned[7][1]);
  EXPECT_NE(solid_fault(mesh_of(one_turned))
                .find("in the same direction: one of them faces the wrong way"),
            std::string::npos);
  EXPECT_EQ(solid_fault(mesh_of(inverted(l_bracket()))),
            "its facets point inwards: turn them round");
  EXPECT_NE(solid_fault(mesh_of(joined(l_bracket(), l_bracket()))), "");
}

TEST(Stl, SaysWhereAFileIsBroken) {
  const std::string bytes = binary_stl(l_bracket()), text = text_stl(l_bracket());
  EXPECT_EQ(refusal([&] { read_stl(std::string_view(bytes).substr(0, 200), 1); }),
            "it is cut short: 20 facets need 1084 bytes, and it has 200");
  EXPECT_EQ(refusal([&] { read_stl("", 1); }),
            "it is cut short: 0 bytes are less than the header of a binary STL");
  EXPECT_EQ(refusal([&] { read_stl(std::string_view(text).substr(0, text.find("endloop")), 1); }),
            "line 7: \"endloop\" was expected, but it ends");
  EXPECT_EQ(refusal([&] { read_stl("solid x\nfacet normal 0 0 1 outer loop\nvertex 0 0 O\n", 1); }),
            "line 3: a number was expected, not \"O\"");
  EXPECT_EQ(refusal([&] {
              read_stl(text + std::string(2, '\0'), 1);
            }).substr(std::string_view("line 143: ").size()),
            "\"solid\" or the end was expected, not \"U+0000U+0000\"");
  EXPECT_EQ(refusal([&] { read_stl("solid x\nendsolid x\n", 1); }), "it has no facets");
  EXPECT_EQ(refusal([&] { read_stl("solid x\nfacet normal 0 0 1 outer loop\nvertex 0 0 nan", 1); }),
            "line 3: a coordinate is not finite");
}

TEST(Stl, SectionsAreSolidsOrPatches) {
  Facets far = l_bracket(), patch = l_bracket();
  for (auto& facet : far)
    for (Vec3& p : facet) p.x += 5;
  const TriangleMesh two = read_stl(text_stl(l_bracket()) + text_stl(far), 1);
  EXPECT_EQ(two.facets.size(), 40u);
  EXPECT_EQ(two.sections, (std::vector<std::size_t>{0, 20}));
  EXPECT_EQ(solid_fault(two), "");
  EXPECT_TRUE(InsideTest(two)({0.5, 10.5, 0.5}));
  EXPECT_TRUE(InsideTest(two)({5.5, 10.5, 0.5}));

  const Facets first(patch.begin(), patch.begin() + 7), second(patch.begin() + 7, patch.end());
  EXPECT_EQ(solid_fault(read_stl(text_stl(first) + text_stl(second), 1)), "");

  for (auto& facet : far)
    for (Vec3& p : facet) p.x -= 3;  // the two faces now touch
  const TriangleMesh touching = read_stl(text_stl(l_bracket()) + text_stl(far), 1);
  EXPECT_NE(solid_fault(touching), "");
  EXPECT_TRUE(sections_are_solids(touching));
  EXPECT_TRUE(InsideTest(touching)({1.5, 10.5, 0.5}));
  EXPECT_TRUE(InsideTest(touching)({2.5, 10.5, 0.5}));
  EXPECT_FALSE(sections_are_solids(read_stl(text_stl(first) + text_stl(far), 1)));
  EXPECT_EQ(refusal([] { read_stl(text_stl(l_bracket()) + "more", 1); }),
            "line 143: \"solid\" or the end was expected, not \"more\"");
}

TEST(Stl, ContentTellsTextFromBinary) {
  const std::string text = text_stl(l_bracket());
  const auto expected = read_stl(text, 1).facets;
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string all = text;
    for (std::size_t at = 0; (at = all.find(from, at)) != std::string::npos; at += to.size())
      all.replace(at, from.size(), to);
    return all;
  };
  std::string upper = text;
  for (char& c : upper) c = static_cast<char>(std::toupper(c));
  for (const std::string& same :
       {upper, " \r\n" + text, "\xEF\xBB\xBF" + text, "\xEF\xBB\xBF\n" + text, changed("\n", "\r"),
        changed("\n", "\r\n"), changed("endsolid", "end solid"), changed("endloop", "end loop"),
        changed("endfacet", "EndFacet"), changed(" a name", ""), text + "\n \n"})
    EXPECT_EQ(read_stl(same, 1).facets, expected) << same.substr(0, 40);
  EXPECT_EQ(refusal([&] { read_stl(changed("\n", "\r").substr(0, 120), 1); }).substr(0, 7),
            "line 5:");
  EXPECT_EQ(refusal([&] { read_stl("\xFF\xFEs\0o\0l\0", 1); }),
            "it is a text in UTF-16: save it in ASCII or UTF-8");
  EXPECT_NE(refusal([&] {
              read_stl(std::string(100, 'x'), 1);
            }).find("a text would begin with \"solid\""),
            std::string::npos);

  const std::string binary = binary_stl(l_bracket());
  EXPECT_EQ(read_stl(binary + std::string(100, '\0'), 1).facets, expected);
  EXPECT_EQ(refusal([&] { read_stl(binary + binary, 1); }),
            "it counts 20 facets, and 1084 bytes stand behind them: are these several solids, or "
            "is the count wrong?");
  std::string named = binary + "\n";
  named.replace(0, 5, "solid");
  EXPECT_EQ(read_stl(named, 1).facets, expected);
}

TEST(Stl, FacetsHaveTheirNumbersOfTheFile) {
  Facets open = l_bracket();
  open.pop_back();
  open.insert(open.begin(), 3, {Vec3{0, 0, 0}, Vec3{0, 0, 0}, Vec3{1, 0, 0}});
  EXPECT_EQ(solid_fault(mesh_of(open)),
            "the surface is open: no other facet shares the edge from (0, 2, 1) to (0, 0, 1) "
            "(metres) of facet 9");
}

TEST(Stl, CornersThatNearlyMeetAreTold) {
  Facets seam = l_bracket();
  seam[5][1].x += 1e-6;
  const std::string fault = solid_fault(mesh_of(seam));
  EXPECT_NE(fault.find("m from there: corners of neighbours must be the same to the last digit"),
            std::string::npos)
      << fault;
}

TEST(Stl, PartsThatFaceTheWrongWayAreTold) {
  const auto fault = [](const Facets& facets) {
    return orientation_fault(InsideTest(mesh_of(facets)));
  };
  EXPECT_EQ(fault(joined(ball(5, 20), inverted(ball(2, 20)))), "");
  EXPECT_EQ(fault(joined(ball(5, 20), ball(2, 20))),
            "the closed surface that facet 1602 belongs to lies within another and faces outwards: "
            "around a cavity facets point into it");
  EXPECT_EQ(fault(joined(joined(ball(5, 20), inverted(ball(3, 20))), ball(1, 20))),
            "");  // the inner ball lies within the cavity
  Facets far = inverted(ball(1, 20));
  for (auto& facet : far)
    for (Vec3& p : facet) p.x += 10;
  EXPECT_NE(fault(joined(ball(5, 20), far)).find("lies within no other and points inwards"),
            std::string::npos);
  Facets near = ball(2, 20);
  for (auto& facet : near)
    for (Vec3& p : facet) p.x += 4.5;
  EXPECT_EQ(fault(joined(ball(5, 20), near)), "");  // the balls overlap and form a union
}

TEST(Stl, KnowsInsideAtEdgesAndCornersToo) {
  const InsideTest inside(mesh_of(l_bracket()));
  // The coordinates are quarters of the bracket's, so that some rays run along faces and edges, and
  // through corners.
  for (int i = -2; i <= 10; ++i)
    for (int j = -2; j <= 10; ++j)
      for (int k = -2; k <= 6; ++k) {
        const Vec3 p{i / 4.0, j / 4.0, k / 4.0};
        const auto near_surface = [](double c) { return c == 0 || c == 1 || c == 2; };
        if (near_surface(p.x) || near_surface(p.y) || near_surface(p.z)) continue;
        EXPECT_EQ(inside(p), in_l_bracket(p)) << p.x << ' ' << p.y << ' ' << p.z;
      }
  // Rays from these points meet corners and edges, but the points are far from the surface.
  for (const double y : {0.0, 1.0, 2.0})
    for (const double z : {0.0, 1.0})
      for (const double x : {-0.5, 2.5}) EXPECT_FALSE(inside({x, y, z}));
  EXPECT_TRUE(inside({0.5, 1, 0.5}));  // a ray along x meets the inner edge of the L
  EXPECT_FALSE(inside({1.5, 1.5, 0.5}));
}

TEST(Stl, AgreesWithBallAndTorus) {
  const InsideTest in_ball(mesh_of(joined(ball(5, 60), inverted(ball(2, 60))))),
      in_torus(mesh_of(torus(3, 1, 80)));
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-5.5, 5.5);
  for (int n = 0; n < 20000; ++n) {
    // A quarter of the points lie in the plane z = 0 of the equators' corners.
    const Vec3 p{place(random), place(random), n % 4 == 0 ? 0 : place(random)};
    const double r = norm(p), tube = std::hypot(std::hypot(p.x, p.y) - 3, p.z);
    if (std::abs(r - 5) > 0.02 && std::abs(r - 2) > 0.02) {
      EXPECT_EQ(in_ball(p), r > 2 && r < 5) << r;
    }
    if (std::abs(tube - 1) > 0.02) {
      EXPECT_EQ(in_torus(p), tube < 1) << tube;
    }
  }
  EXPECT_EQ(in_ball.winding({3, 0, 0}), 1);
  EXPECT_FALSE(in_ball({0, 0, 0}));
  EXPECT_TRUE(in_ball({3, 0, 0}));
}

/// A lattice that fills an STL file of a box equals the lattice of the box.
TEST(Stl, FillsALattice) {
  const test::Folder folder("stl");
  const Facets box =
      prism({{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}}, {{0, 1, 2}, {0, 2, 3}}, 30);
  std::ofstream(folder.file("box.stl"), std::ios::binary) << binary_stl(box);
  const auto plan = [&](const Json& shape) {
    return test::plan_of(
        test::SceneBuilder{}
            .stage("lattices.cubic", {{"spacing", "1 mm"}, {"shape", shape}})
            .material("materials.elastic", {{"young", 1e10}, {"poisson", 0.25}, {"density", 2500}})
            .solver("solvers.explicit", {{"end_time", 1e-6}})
            .text());
  };
  const auto from_stl = plan({{"stl", {{"file", folder.file("box.stl")}, {"scale", "1 mm"}}}});
  EXPECT_EQ(from_stl->model->body.particles, 3000u);
  EXPECT_EQ(from_stl->model->body.base_springs(),
            plan(test::box({}, {0.01, 0.01, 0.03}))->model->body.base_springs());
  const std::string why = refusal([&] { plan({{"stl", {{"file", folder.file("none.stl")}}}}); });
  EXPECT_NE(why.find("/pipeline/0/shape/stl/file"), std::string::npos) << why;
  EXPECT_NE(why.find("there is no such file"), std::string::npos) << why;
}

}  // namespace stl_test
