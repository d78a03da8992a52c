// Bodies that are broken along known planes: the pieces, their masses and motions, and the faces of
// the cracks, against closed forms.
#include <model/section.hpp>
#include <plan/fields.hpp>
#include <run/snapshot.hpp>
#include <state/crack_faces.hpp>
#include <support/cuts.hpp>
#include <support/lists.hpp>
#include <support/output.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>

namespace fragments_test {
using namespace hyperlattice;
using namespace hyperlattice::test;

const Keys brittle = {{"poisson", 0.25},
                      {"failure", {{"type", "failures.elongation"}, {"limit", 1e-7}}}};
constexpr double density = 2500;  // of block()

/// A body, and the view of it that outputs get.
struct Broken {
  std::unique_ptr<Plan> plan;
  Simulation simulation;
  SnapshotSource source;

  /// Breaks the springs between particles to which `group` gives different numbers: it moves the
  /// groups apart, takes one short step and moves them back.
  Broken(const std::string& scene, const std::function<int(Vec3)>& group, int threads = 1)
      : plan(plan_of(scene, threads)),
        simulation(*plan->model, threads),
        source(*plan->model, simulation) {
    std::vector<double> u;
    for (Particle p = 0; p < model().body.particles; ++p) {
      const double apart = 1e-3 * group(model().body.position(p));
      u.insert(u.end(), {7 * apart, 11 * apart, 13 * apart});
    }
    simulation.set_displacements(u, {});
    simulation.step(1e-6 * model().step_limit.time_step);
    simulation.set_displacements(std::vector<double>(u.size(), 0.0), {});
    simulation.set_velocities(std::vector<double>(u.size(), 0.0), {});
  }

  const Model& model() const { return *plan->model; }
  /// The view of the present state.
  const Snapshot& snapshot() {
    source.renew();
    return source.take();
  }
  std::vector<double> field(std::string_view name) {
    Field found;
    EXPECT_TRUE(snapshot().field(name, found)) << name;
    return {found.values.begin(), found.values.end()};
  }
  /// The row of probes.fragments, by columns.
  std::map<std::string, double> sample(const nlohmann::json& options = nlohmann::json::object()) {
    Plugin probe("probes.fragments", options);
    const std::vector<std::string_view> fields = fields_of(model());
    OutputContext context;
    context.fields = fields;
    const std::vector<std::string> columns = probe.begin_probe(context, snapshot());
    const std::vector<double> row = probe.sample(snapshot(), columns.size());
    std::map<std::string, double> found;
    for (std::size_t n = 0; n < columns.size(); ++n) found[columns[n]] = row[n];
    return found;
  }
};

std::string boundary_block(const char* boundary, const Json& shape) {
  return SceneBuilder{}
      .lattice("lattices.cubic", 1e-3, shape, {{"boundary", boundary}})
      .material("materials.elastic", Keys{{"young", 1e10}, {"density", density}} + brittle)
      .solver("solvers.explicit", {{"end_time", 1e-6}})
      .text();
}

std::function<int(Vec3)> above(double z) {
  return [z](Vec3 x) { return x.z > z ? 1 : 0; };
}

struct TwoPieces {
  const char* name;
  std::string scene;
  double plane;              ///< its height, m
  double area = 12e-6;       ///< of the plane, m2; 0: the surface of the body is rough
  double tolerance = 1e-12;  ///< of the area, over the area
};
/// Shares of partial cells are multiples of 2^-20.
constexpr double rounding_of_shares = 0x1p-20;
std::vector<TwoPieces> two_pieces() {
  static const ListFiles list(3, 4, 5);
  return {{"cubic", block(3, 4, 5, brittle), 2e-3},
          {"cells", boundary_block("cells", box_mm(3, 4, 5)), 1.5e-3},
          {"partial_cells", boundary_block("partial_cells", box({}, {3.4e-3, 4e-3, 5e-3})), 1.5e-3,
           13.6e-6, rounding_of_shares},
          {"bcc", block(3, 4, 5, brittle, {}, "lattices.bcc"), 2e-3, 0},
          {"fcc", block(3, 4, 5, brittle, {}, "lattices.fcc"), 2e-3, 0},
          {"list",
           SceneBuilder{}
               .stages(list.lattice())
               .material("materials.elastic", Keys{{"young", 1e10}, {"density", density}} + brittle)
               .solver("solvers.explicit", {{"end_time", 1e-6}})
               .text(),
           2e-3, 46.0 / 525 * 180e-6}};  // springs cut / sum R^2 of all, 3 V: see OfAList
}

// Each half moves and turns on its own. The probe finds both motions; the pieces have the mass and
// the kinetic energy of the body.
TEST(Fragments, TwoHalvesMoveOnTheirOwn) {
  for (const TwoPieces& of : two_pieces()) {
    SCOPED_TRACE(of.name);
    Broken body(of.scene, above(of.plane));
    const Model& model = body.model();
    ASSERT_GT(body.simulation.broken(), 0U);
    const Vec3 velocity[2] = {{1, -2, 0.5}, {-3, 0.25, 4}}, spin[2] = {{0, 0, 0}, {20, -30, 50}};
    double mass[2] = {}, kinetic[2] = {};
    Vec3 centre[2];
    const auto side = [&](Particle p) { return model.body.position(p).z > of.plane ? 1 : 0; };
    for (Particle p = 0; p < model.body.particles; ++p) {
      mass[side(p)] += model.mass(p);
      centre[side(p)] += model.mass(p) * model.body.position(p);
    }
    std::vector<double> v;
    for (Particle p = 0; p < model.body.particles; ++p) {
      const int s = side(p);
      const Vec3 own = velocity[s] + cross(spin[s], model.body.position(p) - centre[s] / mass[s]);
      v.insert(v.end(), {own.x, own.y, own.z});
      kinetic[s] += model.mass(p) / 2 * dot(own, own);
    }
    body.simulation.set_velocities(v, {});
    ASSERT_GT(mass[1], mass[0]);
    const std::vector<double> fragment = body.field("fragment");
    for (Particle p = 0; p < model.body.particles; ++p)
      ASSERT_EQ(fragment[p], side(p) == 1 ? 0 : 1);
    auto row = body.sample();
    EXPECT_EQ(row["fragments"], 2);
    EXPECT_EQ(row["dust"], 0);
    for (const int s : {0, 1}) {
      const std::string n = s == 1 ? "_0" : "_1";
      EXPECT_NEAR(row["mass" + n], mass[s], 1e-13 * mass[s]);
      EXPECT_NEAR(row["kinetic" + n], kinetic[s], 1e-12 * kinetic[s]);
      EXPECT_NEAR(row["size" + n], std::cbrt(6 * mass[s] / density / std::numbers::pi),
                  1e-13 * row["size" + n]);
      for (int axis = 0; axis < 3; ++axis) {
        const std::string letter = std::string("_") + "xyz"[axis] + n;
        EXPECT_NEAR(row[letter.substr(1)], centre[s][axis] / mass[s], 1e-16);
        EXPECT_NEAR(row["velocity" + letter], velocity[s][axis], 1e-13);
        EXPECT_NEAR(row["spin" + letter], spin[s][axis], 1e-9);
      }
    }
    EXPECT_NEAR(row["mass"], mass[0] + mass[1], 1e-13 * row["mass"]);
    EXPECT_NEAR(row["kinetic"], body.simulation.kinetic(), 1e-12 * row["kinetic"]);
    EXPECT_EQ(row["mass_2"], 0);
  }
}

TEST(Fragments, HalvesHaveTheMassOfTheirVolume) {
  for (const double plane : {1.5e-3, 2.5e-3}) {
    Broken body(boundary_block("cells", box_mm(3, 4, 6)), above(plane));
    auto row = body.sample();
    EXPECT_NEAR(row["mass_0"], density * 12e-6 * (6e-3 - plane), 1e-12 * row["mass_0"]);
    EXPECT_NEAR(row["mass_1"], density * 12e-6 * plane, 1e-12 * row["mass_1"]);
  }
}

// Eight equal cubes: the order of equal masses is that of their first particles.
TEST(Fragments, EqualPiecesAreNumberedByTheirFirstParticle) {
  const auto octant = [](Vec3 x) {
    return (x.x > 2e-3 ? 1 : 0) + (x.y > 2e-3 ? 2 : 0) + (x.z > 2e-3 ? 4 : 0);
  };
  Broken body(block(4, 4, 4, brittle), octant);
  const std::vector<double> fragment = body.field("fragment");
  for (Particle p = 0; p < fragment.size(); ++p)
    EXPECT_EQ(fragment[p], octant(body.model().body.position(p)));
}

// Loose particles are dust, if they are lighter than the least mass.
TEST(Fragments, DustIsCountedApart) {
  const auto crumble = [](Vec3 x) {
    return x.z > 4e-3 ? static_cast<int>(1 + std::floor(x.x * 1e3) + 3 * std::floor(x.y * 1e3)) : 0;
  };
  Broken body(block(3, 3, 5, brittle), crumble);
  const double particle = density * 1e-9;
  auto all = body.sample();
  EXPECT_EQ(all["fragments"], 10);
  EXPECT_NEAR(all["mass_1"], particle, 1e-12 * particle);
  EXPECT_EQ(all["spin_x_1"], 0);
  EXPECT_EQ(all["bin_1"], 1);  // 36 of 45 particles
  EXPECT_EQ(all["bin_6"], 9);  // 1 of 45: above 1/64, at most 1/32
  auto row = body.sample({{"least_mass", 1.5 * particle}, {"bins", 3}});
  EXPECT_EQ(row["fragments"], 1);
  EXPECT_NEAR(row["mass"], 36 * particle, 1e-12 * row["mass"]);
  EXPECT_EQ(row["dust"], 9);
  EXPECT_NEAR(row["dust_mass"], 9 * particle, 1e-12 * row["dust_mass"]);
  EXPECT_EQ(row["bin_1"], 1);
  EXPECT_EQ(row["bin_2"] + row["bin_3"], 0);
  EXPECT_EQ(row.count("bin_4"), 0U);
}

// Bars of 1, 2, 3 and 4 particles: a tenth of the mass is in the smallest.
TEST(Fragments, SizesHoldPartsOfTheMass) {
  const auto bar = [](Vec3 x) { return x.z < 1e-3 ? 0 : x.z < 3e-3 ? 1 : x.z < 6e-3 ? 2 : 3; };
  Broken body(block(1, 1, 10, brittle), bar);
  auto row = body.sample({{"largest", 4}});
  EXPECT_EQ(row["fragments"], 4);
  EXPECT_EQ(row["size_20"], row["size_2"]);  // 1 + 2 of 10
  EXPECT_EQ(row["size_50"], row["size_1"]);  // 1 + 2 + 3
  EXPECT_EQ(row["size_80"], row["size_0"]);
  EXPECT_EQ(row["spin_z_0"], 0);  // on a line
}

// Half of the springs break at random: many pieces, and the same numbers for any threads.
TEST(Fragments, NumbersDoNotDependOnThreads) {
  const auto at_random = [](Vec3 x) {
    const double hash = std::sin(1e5 * x.x + 3.7e5 * x.y + 5.1e5 * x.z) * 43758.5453;
    return static_cast<int>(4 * (hash - std::floor(hash)));
  };
  std::optional<std::vector<double>> first;
  for (const int threads : {1, 2, 5}) {
    Broken body(block(9, 8, 11, brittle), at_random, threads);
    const std::vector<double> fragment = body.field("fragment");
    EXPECT_GT(*std::max_element(fragment.begin(), fragment.end()), 20);
    if (!first) first = fragment;
    EXPECT_EQ(fragment, *first) << threads;
  }
}

/// Compares the pieces with a search through the springs that are left.
TEST(Fragments, AreThePiecesThatASearchFinds) {
  const auto at_random = [](Vec3 x) {
    const double hash = std::sin(1e5 * x.x + 3.7e5 * x.y + 5.1e5 * x.z) * 43758.5453;
    return static_cast<int>(3 * (hash - std::floor(hash)));
  };
  for (const char* lattice : {"lattices.cubic", "lattices.bcc", "lattices.fcc"}) {
    Broken body(block(5, 6, 4, brittle, {}, lattice), at_random);
    const Model& model = body.model();
    std::set<std::pair<Particle, Particle>> gone;
    for (const Breakage& breakage : body.simulation.breakages())
      gone.insert({breakage.a, breakage.b});
    std::vector<std::vector<Particle>> joined(model.body.particles);
    model.body.for_springs([&](Particle a, Particle b, std::uint32_t) {
      if (gone.count({a, b}) > 0) return;
      joined[a].push_back(b);
      joined[b].push_back(a);
    });
    const std::vector<double> fragment = body.field("fragment");
    std::vector<char> seen(model.body.particles, 0);
    std::set<double> numbers;
    for (Particle start = 0; start < model.body.particles; ++start) {
      if (seen[start] != 0) continue;
      EXPECT_TRUE(numbers.insert(fragment[start]).second) << "two pieces have one number";
      std::vector<Particle> left{start};
      seen[start] = 1;
      while (!left.empty()) {
        const Particle here = left.back();
        left.pop_back();
        EXPECT_EQ(fragment[here], fragment[start]);
        for (const Particle next : joined[here])
          if (seen[next]++ == 0) left.push_back(next);
      }
    }
    EXPECT_GT(numbers.size(), 5U);
  }
}

double area_of(const CrackFace& face) {
  const Vec3 first = face.corners[1] - face.corners[0], second = face.corners[3] - face.corners[0];
  return norm(cross(first, second));
}

// A straight crack has the area of the cross-section, whatever the lattice: faces of oblique
// springs count by their projection.
TEST(CrackFaces, OfAStraightCrackHaveTheAreaOfTheSection) {
  for (const TwoPieces& of : two_pieces()) {
    SCOPED_TRACE(of.name);
    Broken body(of.scene, above(of.plane));
    const Model& model = body.model();
    std::vector<Particle> all(model.body.particles);
    std::iota(all.begin(), all.end(), Particle{0});
    const PlaneSection section = cut(model, {0, 0, of.plane}, {0, 0, 1}, all);
    double projected = 0;
    std::set<std::pair<Particle, Particle>> springs;
    for (const CrackFace& face : body.snapshot().crack_faces(1)) {
      springs.insert({face.a, face.b});
      EXPECT_EQ(face.damage, 1);
      EXPECT_EQ(face.time, body.simulation.breakages().front().time);
      const Vec3 normal = direction_of(model.body.position(face.b) - model.body.position(face.a));
      for (const Vec3 corner : face.corners) {
        const Vec3 from_middle =
            corner - 0.5 * (model.body.position(face.a) + model.body.position(face.b));
        EXPECT_NEAR(dot(normal, from_middle), 0, 1e-15);
      }
      if (face.spring_class == 0) {
        EXPECT_NEAR(area_of(face), face.area, 1e-12 * face.area);
        projected += face.area * std::abs(normal.z);
      } else {
        EXPECT_EQ(face.area, 0);
      }
    }
    EXPECT_EQ(springs.size(), body.simulation.broken());
    EXPECT_NEAR(projected, section.area, 1e-12 * section.area);
    if (of.area > 0) {
      EXPECT_NEAR(projected, of.area, of.tolerance * of.area);
    }
  }
}

// Springs that a cut took away have the faces that they have where they break.
TEST(CutFaces, AreThoseOfBrokenSprings) {
  for (const TwoPieces& of : two_pieces()) {
    SCOPED_TRACE(of.name);
    Broken body(of.scene, above(of.plane));
    auto scene = nlohmann::json::parse(of.scene);
    scene["pipeline"][0]["cuts"] = Json::array({plane({0, 0, of.plane}, {0, 0, 1})});
    const auto cut_plan = plan_of(scene.dump());
    const auto by_ends = [](std::span<const CrackFace> faces) {
      std::multimap<std::pair<Particle, Particle>, CrackFace> sorted;
      for (const CrackFace& face : faces) sorted.emplace(std::pair(face.a, face.b), face);
      return sorted;
    };
    const auto expected = by_ends(body.snapshot().crack_faces(1)),
               found = by_ends(cut_faces(*cut_plan->model));
    ASSERT_EQ(found.size(), expected.size());
    ASSERT_GT(found.size(), 0U);
    auto broken = expected.begin();
    for (const auto& [ends, face] : found) {
      EXPECT_EQ(ends, broken->first);
      EXPECT_EQ(face.time, 0);
      EXPECT_EQ(face.damage, 1);
      EXPECT_EQ(face.spring_class, broken->second.spring_class);
      EXPECT_NEAR(face.area, broken->second.area, 1e-12 * broken->second.area);
      for (std::size_t n = 0; n < 4; ++n)
        EXPECT_LT(norm(face.corners[n] - broken->second.corners[n]), 1e-15);
      ++broken;
    }
    EXPECT_TRUE(cut_faces(body.model()).empty());
  }
}

// The m of a list is a mean over its body. A block of n^3 points, each of a volume l^3, has springs
// over n - 1 of n spacings along each axis, so that m is smaller than in an infinite lattice and
// the area larger: by n / (n - 1) exactly.
TEST(CrackFaces, OfAListAreLargerByASpacingOverTheSizeOfTheBody) {
  for (const int n : {3, 6}) {
    const ListFiles list(n, n, n);
    Broken body(
        SceneBuilder{}
            .stages(list.lattice())
            .material("materials.elastic", Keys{{"young", 1e10}, {"density", density}} + brittle)
            .solver("solvers.explicit", {{"end_time", 1e-6}})
            .text(),
        above(2e-3));
    double projected = 0;
    for (const CrackFace& face : body.snapshot().crack_faces(1)) {
      const Vec3 rest = body.model().body.position(face.b) - body.model().body.position(face.a);
      projected += face.area * std::abs(direction_of(rest).z);
    }
    EXPECT_NEAR(projected / (n * n * 1e-6), n / (n - 1.0), 1e-12);
  }
}

// The faces of a body of cells lie inside it.
TEST(CrackFaces, OfCellsAreInsideTheBody) {
  Broken body(boundary_block("cells", box_mm(3, 4, 5)), above(1.5e-3));
  for (const CrackFace& face : body.snapshot().crack_faces(1)) {
    if (face.spring_class != 0) continue;
    for (const Vec3 corner : face.corners) {
      EXPECT_NEAR(corner.z, 1.5e-3, 1e-15);
      EXPECT_TRUE(corner.x > -1e-15 && corner.x < 3e-3 + 1e-15);
      EXPECT_TRUE(corner.y > -1e-15 && corner.y < 4e-3 + 1e-15);
    }
  }
}

// A law that softens: the spring stays, and joins its ends as long as its damage is below the
// bound.
TEST(Softened, SpringsJoinBelowABound) {
  const std::string scene = SceneBuilder{}
                                .lattice("lattices.cubic", 1e-3, box_mm(1, 1, 2))
                                .material("materials.softening", {{"young", 1e10},
                                                                  {"density", density},
                                                                  {"poisson", 0.25},
                                                                  {"strength", 1e6},
                                                                  {"fracture_energy", 1}})
                                .solver("solvers.explicit", {{"end_time", 1e-6}})
                                .text();
  const auto plan = plan_of(scene);
  Simulation simulation(*plan->model, 1);
  SnapshotSource source(*plan->model, simulation);
  const auto stretch = [&](double elongation) {
    const std::vector<double> still(6, 0.0);
    simulation.set_displacements({0, 0, 0, 0, 0, elongation}, {});
    simulation.set_velocities(still, {});
    simulation.step(1e-12);
    simulation.set_velocities(still, {});
    simulation.step(1e-12);
    source.renew();
    return source.take();
  };
  double elongation = 1e-8, damage = 0;
  while (damage < 0.3) {
    elongation *= 1.02;
    ASSERT_LT(elongation, 1e-3);
    const Snapshot snapshot = stretch(elongation);
    Field field;
    ASSERT_TRUE(snapshot.field("damage", field));
    damage = field.values[0];
  }
  ASSERT_LT(damage, 0.9);
  const Snapshot snapshot = source.take();
  EXPECT_EQ(snapshot.fragments(1)[1], 0);
  EXPECT_EQ(snapshot.fragments(damage + 0.01)[1], 0);
  EXPECT_EQ(snapshot.fragments(damage)[1], 1);
  EXPECT_EQ(snapshot.crack_faces(1).size(), 0U);
  EXPECT_EQ(snapshot.crack_faces(damage + 0.01).size(), 0U);
  ASSERT_EQ(snapshot.crack_faces(damage).size(), 1U);
  EXPECT_TRUE(std::isnan(snapshot.crack_faces(damage)[0].time));
  EXPECT_EQ(snapshot.crack_faces(damage)[0].damage, damage);
  const Snapshot open = stretch(0.5e-3);
  EXPECT_EQ(open.fragments(1)[1], 1);
  ASSERT_EQ(open.crack_faces(1).size(), 1U);
  EXPECT_EQ(open.crack_faces(1)[0].time, simulation.breakages().front().time);
}

// A bar of a cohesive material whose two middle layers of cells are weaker is pulled apart. It
// leaves two halves, and the particles between them whose damage is 1 as dust.
TEST(Cohesive, ABarThatIsPulledApartHasTwoHalvesAndDust) {
  constexpr double length = 24e-3;
  const auto material = [](double strength) {
    return Keys{{"young", 1e10},
                {"density", density},
                {"poisson", 0.25},
                {"failure",
                 {{"type", "failures.cohesive"},
                  {"strength", strength},
                  {"fracture_energy", 90},
                  {"length", 3e-3}}}};
  };
  const auto plan = plan_of(
      SceneBuilder{}
          .lattice("lattices.cubic", 1e-3, box({}, {length, 2e-3, 2e-3}), {{"boundary", "cells"}})
          .material("materials.elastic", material(1e7))
          .material("materials.elastic",
                    material(0.8e7) +
                        Keys{{"name", "weak"}, {"region", box({11e-3, -1, -1}, {13e-3, 1, 1})}})
          .load("loads.velocity", {{"name", "left"},
                                   {"on", "x_min"},
                                   {"axes", "x"},
                                   {"value", Vec3{-0.4, 0, 0}},
                                   {"rise", 20e-6}})
          .load("loads.velocity", {{"name", "right"},
                                   {"on", "x_max"},
                                   {"axes", "x"},
                                   {"value", Vec3{0.4, 0, 0}},
                                   {"rise", 20e-6}})
          .solver("solvers.explicit", {{"end_time", 2e-4}})
          .text());
  const Model& model = *plan->model;
  Simulation simulation(model, 1);
  SnapshotSource source(model, simulation);
  const auto snapshot = [&] {
    source.renew();
    return source.take();
  };
  EXPECT_EQ(snapshot().crack_faces(0.01).size(), 0U);
  while (simulation.time() < 2e-4) simulation.step(0.85 * model.step_limit.time_step);
  const auto numbers = snapshot().fragments(1);
  ASSERT_EQ(numbers.size(), model.body.particles);
  double mass[2] = {}, whole = 0;
  for (Particle p = 0; p < numbers.size(); ++p) {
    whole += model.mass(p);
    if (numbers[p] > 1) continue;
    mass[static_cast<int>(numbers[p])] += model.mass(p);
    const bool is_left = model.body.position(p).x < length / 2;
    EXPECT_EQ(numbers[p] == numbers[0], is_left) << p;
  }
  EXPECT_NEAR(mass[0], mass[1], 0.1 * whole);
  EXPECT_GT(mass[0] + mass[1], 0.7 * whole);
  std::vector<double> damage(model.body.particles, 0);
  simulation.copy_damage(damage);
  double projected = 0;
  for (const CrackFace& face : snapshot().crack_faces(0.9)) {
    EXPECT_GE(face.damage, 0.9);
    EXPECT_GT(std::max(damage[face.a], damage[face.b]), 0.5);
    for (const Vec3 corner : face.corners) EXPECT_NEAR(corner.x, length / 2, 6e-3);
    const Vec3 rest = model.body.position(face.b) - model.body.position(face.a);
    if (face.damage == 1) projected += face.area * std::abs(direction_of(rest).x);
    EXPECT_EQ(std::isnan(face.time), face.damage < 1);
  }
  // At least one whole layer of springs across the bar.
  EXPECT_GE(projected, 4e-6 * (1 - 1e-12));
}

// Writers that name fields get copies, which know no springs.
TEST(CrackFaces, AreRefusedInCopies) {
  const Snapshot copy;
  EXPECT_THROW(copy.crack_faces(1), std::runtime_error);
  EXPECT_THROW(copy.fragments(1), std::runtime_error);
}

}  // namespace fragments_test
