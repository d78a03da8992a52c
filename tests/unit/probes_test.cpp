// Probes: the particles that they choose, the names of their columns, and their values in a known
// motion.
#include <support/output.hpp>

#include <gtest/gtest.h>

namespace hyperlattice::test {
namespace probes_test {

std::string refusal(Plugin& probe, FakeBody& body) {
  try {
    probe.begin_probe(body.context("."), body.at(0));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(PointProbe, TakesTheNearestParticleAndSaysWhere) {
  FakeBody body({4, 4, 4});
  Plugin probe("probes.point", {{"position", {1.9e-3, 0.1e-3, 3.6e-3}}});
  const auto columns = probe.begin_probe(body.context("."), body.at(0));
  EXPECT_EQ(columns, (std::vector<std::string>{"displacement_x@(0.0015 0.0005 0.0035)",
                                               "displacement_y@(0.0015 0.0005 0.0035)",
                                               "displacement_z@(0.0015 0.0005 0.0035)"}));
  const double t = 0.5, l = 1e-3;
  const auto row = probe.sample(body.at(t), 3);
  EXPECT_DOUBLE_EQ(row[0], t * (1.5 * l - l) + t * t * 0.5 * l);
  EXPECT_DOUBLE_EQ(row[1], t * (0.5 * l - l) + t * t * 3.5 * l);
  EXPECT_DOUBLE_EQ(row[2], t * (3.5 * l - l) + t * t * 1.5 * l);
}

TEST(PointProbe, GivesComponents) {
  FakeBody body({4, 4, 4});
  const std::vector<double> place{1.5e-3, 0.5e-3, 3.5e-3};
  const auto value = [&](const std::string& component, const std::string& column) {
    Plugin probe("probes.point", {{"position", place},
                                  {"field", "velocity"},
                                  {"component", component},
                                  {"centre", {0.0, 0.0, 1e-3}}});
    const auto columns = probe.begin_probe(body.context("."), body.at(0));
    EXPECT_EQ(columns, std::vector<std::string>{column + "@(0.0015 0.0005 0.0035)"});
    return probe.sample(body.at(0), 1)[0];
  };
  const double x = 0.5e-3, y = -0.5e-3, z = 2.5e-3;  // velocity at time 0
  EXPECT_DOUBLE_EQ(value("y", "velocity_y"), y);
  EXPECT_DOUBLE_EQ(value("magnitude", "velocity_magnitude"), std::sqrt(x * x + y * y + z * z));
  EXPECT_DOUBLE_EQ(value("radial", "velocity_radial"),
                   (x * 1.5 + y * 0.5 + z * 2.5) / std::sqrt(1.5 * 1.5 + 0.5 * 0.5 + 2.5 * 2.5));
}

TEST(PointProbe, RefusesWhatItCannotGive) {
  FakeBody body({4, 4, 4});
  Plugin away("probes.point", {{"position", {0.0, 0.0, 9e-3}}});
  EXPECT_EQ(
      refusal(away, body),
      "no particle is near (0 0 0.009); the nearest stands at (0.0005 0.0005 0.0035) (metres)");
  Plugin missing("probes.point", {{"position", {0.0, 0.0, 0.0}}, {"field", "height"}});
  EXPECT_EQ(refusal(missing, body),
            "this run has no field \"height\"; it has displacement, velocity, broken_open, "
            "broken_closed");
  const auto faults =
      Plugin("probes.point",
             {{"position", {0.0, 0.0, 0.0}}, {"field", "damage"}, {"component", "x"}})
          .faults();
  EXPECT_EQ(faults, std::vector<std::string>{
                        "component: no component, because \"damage\" is a single number"});
}

TEST(LineProbe, GivesEachParticleOnceAndNoneInTheOpen) {
  FakeBody body({6, 2, 2});
  // The line starts inside and ends 4 mm beyond the body. It has many more points than the body has
  // particles.
  Plugin probe("probes.line", {{"start", {0.5e-3, 0.6e-3, 0.6e-3}},
                               {"end", {10.5e-3, 0.6e-3, 0.6e-3}},
                               {"points", 101},
                               {"component", "x"},
                               {"between", "nearest"}});
  const auto columns = probe.begin_probe(body.context("."), body.at(0));
  ASSERT_EQ(columns.size(), 6u);
  EXPECT_EQ(columns[0], "displacement_x@(0.0005 0.0005 0.0005)");
  EXPECT_EQ(columns[5], "displacement_x@(0.0055 0.0005 0.0005)");
  const double t = 0.25, l = 1e-3;
  const auto row = probe.sample(body.at(t), 6);
  for (std::size_t n = 0; n < 6; ++n)
    EXPECT_DOUBLE_EQ(row[n], t * ((static_cast<double>(n) + 0.5) * l - l) + t * t * 0.5 * l);
}

/// Moves each particle by its own random vector, at most a quarter of the spacing in each
/// direction.
void shake(FakeBody& body, double spacing) {
  std::uint32_t random = 7;
  for (double& x : body.positions()) {
    random = random * 1664525u + 1013904223u;
    x += spacing * (static_cast<double>(random >> 8) / 16777216.0 - 0.5) / 2;
  }
}

// The motion of the body is affine. Interpolated values are then exact inside and up to a spacing
// outside, on a lattice or not.
TEST(LineProbe, InterpolatesAffineFieldsExactly) {
  constexpr double l = 1e-3, t = 0.25;
  for (const bool shaken : {false, true})
    for (const std::array<int, 3> counts : {std::array{6, 5, 4}, {6, 2, 2}}) {
      FakeBody body(counts, l);
      if (shaken) shake(body, l);
      const Vec3 start{-0.2 * l, 0.3 * l, 0.7 * l}, end{6.1 * l, 1.9 * l, 1.4 * l};
      Plugin probe(
          "probes.line",
          {{"start", {start.x, start.y, start.z}}, {"end", {end.x, end.y, end.z}}, {"points", 41}});
      ASSERT_EQ(probe.begin_probe(body.context("."), body.at(0)).size(), 3 * 41u);
      const auto row = probe.sample(body.at(t), 3 * 41);
      for (std::size_t n = 0; n < 41; ++n) {
        const Vec3 x = start + static_cast<double>(n) / 40 * (end - start);
        EXPECT_NEAR(row[3 * n], t * (x.x - l) + t * t * x.y, 1e-12 * l) << n;
        EXPECT_NEAR(row[3 * n + 1], t * (x.y - l) + t * t * x.z, 1e-12 * l) << n;
        EXPECT_NEAR(row[3 * n + 2], t * (x.z - l) + t * t * x.x, 1e-12 * l) << n;
      }
    }
}

// A single row has no slope across itself. Beside the row, the probe gives the value on the row.
TEST(LineProbe, BesideARowItIsTheRowsOwn) {
  constexpr double l = 1e-3, t = 0.5;
  FakeBody body({8, 1, 1}, l);
  Plugin probe("probes.line", {{"start", {l, 0.9 * l, l}},
                               {"end", {6 * l, 0.9 * l, l}},
                               {"points", 11},
                               {"component", "x"}});
  ASSERT_EQ(probe.begin_probe(body.context("."), body.at(0)).size(), 11u);
  const auto row = probe.sample(body.at(t), 11);
  for (std::size_t n = 0; n < 11; ++n)
    EXPECT_NEAR(row[n], t * (0.5 * static_cast<double>(n)) * l + t * t * 0.5 * l, 1e-12 * l);
}

// In curved fields the error of interpolation is of second order in the spacing.
TEST(LineProbe, InterpolatesCurvedFieldsToSecondOrder) {
  const auto error = [](int across) {
    const double l = 6e-3 / across;
    FakeBody body({across, across, across}, l);
    const std::vector<double> start{0.1e-3, 0.2e-3, 0.3e-3}, end{5.9e-3, 5.5e-3, 5.7e-3};
    Plugin probe("probes.line",
                 {{"start", start}, {"end", end}, {"points", 31}, {"component", "x"}});
    probe.begin_probe(body.context("."), body.at(0));
    const auto curved = [](double x, double y, double z) {
      return std::sin(500 * x) * std::cos(300 * y) + 300 * z;
    };
    const Snapshot snapshot = body.at(0);
    for (std::size_t p = 0; p < body.positions().size(); p += 3)
      body.displacements[p] =
          curved(body.positions()[p], body.positions()[p + 1], body.positions()[p + 2]);
    const auto row = probe.sample(snapshot, 31);
    double worst = 0;
    for (std::size_t n = 0; n < 31; ++n) {
      const auto at = [&](std::size_t axis) {
        return start[axis] + static_cast<double>(n) / 30 * (end[axis] - start[axis]);
      };
      worst = std::max(worst, std::abs(row[n] - curved(at(0), at(1), at(2))));
    }
    return worst;
  };
  const double coarse = error(8), fine = error(16);
  std::printf("largest errors %.2e and %.2e\n", coarse, fine);
  EXPECT_LT(coarse, 0.15);
  EXPECT_GT(std::log2(coarse / fine), 1.6);
}

TEST(LineProbe, RefusesALineOfNoLengthOrOutside) {
  EXPECT_EQ(Plugin("probes.line", {{"start", {1.0, 1.0, 1.0}}, {"end", {1.0, 1.0, 1.0}}}).faults(),
            std::vector<std::string>{"end: a point other than \"start\""});
  FakeBody body({2, 2, 2});
  Plugin outside("probes.line", {{"start", {1.0, 0.0, 0.0}}, {"end", {2.0, 0.0, 0.0}}});
  EXPECT_EQ(refusal(outside, body),
            "no particle is near the line from (1 0 0) to (2 0 0) (metres)");
}

TEST(RegionProbe, GivesMeanAndExtremes) {
  FakeBody body({4, 3, 2});
  Plugin probe("probes.region", {{"region", "some"}, {"field", "broken_open"}});
  EXPECT_EQ(probe.begin_probe(body.context("."), body.at(0)),
            (std::vector<std::string>{"broken_open_mean", "broken_open_min", "broken_open_max"}));
  // The region holds particles 1, 4, 7, 10, 13, 16, 19, 22. Only particle 10 has broken springs: 1
  // + 10 % 3 = 2.
  EXPECT_EQ(probe.sample(body.at(1), 3), (std::vector<double>{0.25, 0, 2}));
}

TEST(RegionProbe, KnowsUniformExpansion) {
  // u = t (x - c) + t^2 (y, z, x) is radial about c to first order in t, and the block is symmetric
  // about c.
  FakeBody body({2, 2, 2});
  Plugin probe("probes.region", {{"component", "radial"}, {"centre", {1e-3, 1e-3, 1e-3}}});
  EXPECT_EQ(probe.begin_probe(body.context("."), body.at(0)),
            (std::vector<std::string>{"displacement_radial_mean", "displacement_radial_min",
                                      "displacement_radial_max", "radius"}));
  const double t = 1e-9, radius = std::sqrt(0.75) * 1e-3;
  const auto row = probe.sample(body.at(t), 4);
  for (std::size_t n = 0; n < 3; ++n) EXPECT_NEAR(row[n], t * radius, 1e-8 * t * radius);
  EXPECT_NEAR(row[3], radius, 1e-15);
  Plugin all("probes.region");
  EXPECT_EQ(all.begin_probe(body.context("."), body.at(0)).size(), 9u);
}

TEST(RegionProbe, LeavesOutParticlesWithoutAValue) {
  FakeBody body({2, 2, 2});
  Plugin probe("probes.region", {{"component", "x"}});
  EXPECT_EQ(probe.begin_probe(body.context("."), body.at(0)).size(), 3u);
  for (const double value : probe.sample(body.at(std::nan("")), 3)) EXPECT_TRUE(std::isnan(value));
  // u_x = t (x - c) + t^2 y is no number for x below c, and infinite above.
  for (const double value : probe.sample(body.at(infinity), 3)) EXPECT_EQ(value, infinity);
}

TEST(ExtentProbe, SaysWhereAQuantityExceedsItsBound) {
  FakeBody body({6, 2, 1});
  // u_x = t (x - l) for small t: above 2 l t for the places 3.5 l to 5.5 l.
  const double t = 1e-9, l = 1e-3;
  const auto options = [&](double above) {
    return nlohmann::json{{"component", "x"}, {"above", above}, {"from", {1e-3, 0.0, 0.5e-3}}};
  };
  Plugin probe("probes.extent", options(2 * l * t));
  const auto columns = probe.begin_probe(body.context("."), body.at(0));
  ASSERT_EQ(columns.size(), 13u);
  EXPECT_EQ(columns[3], "x_max");
  EXPECT_EQ(columns[10], "distance_mean");
  const auto row = probe.sample(body.at(t), 13);
  const std::vector<double> expected{6, 3.5 * l, 2.5 * l, 4.5 * l,  // count, x
                                     l, 0.5 * l, 1.5 * l,           // y
                                     0, 0,       0};
  for (std::size_t n = 0; n < expected.size(); ++n) EXPECT_NEAR(row[n], expected[n], 1e-15) << n;
  EXPECT_NEAR(row[11], std::hypot(2.5, 0.5) * l, 1e-15);
  EXPECT_NEAR(row[12], std::hypot(4.5, 1.5) * l, 1e-15);
  nlohmann::json oblique = options(2 * l * t);
  oblique["along"] = {0.0, -2.0, 0.0};
  Plugin turned("probes.extent", oblique);
  EXPECT_EQ(turned.begin_probe(body.context("."), body.at(0)).size(), 16u);
  EXPECT_NEAR(turned.sample(body.at(t), 16)[15], -0.5 * l, 1e-15);
  Plugin nowhere("probes.extent", options(1));
  nowhere.begin_probe(body.context("."), body.at(0));
  EXPECT_EQ(nowhere.sample(body.at(t), 13), std::vector<double>(13, 0));
}

TEST(ExtentProbe, RefusesAVectorWithoutAComponent) {
  EXPECT_EQ(Plugin("probes.extent", {{"above", 1.0}}).faults(),
            std::vector<std::string>{"component: a component of \"displacement\": x, y, z, "
                                     "magnitude, radial"});
}

/// The mean place of a region's particles at rest, m.
Vec3 mean_place(FakeBody& body, const std::vector<Particle>& particles) {
  Vec3 sum;
  for (const Particle p : particles)
    for (const std::size_t axis : {0U, 1U, 2U}) sum[axis] += body.positions()[3 * p + axis];
  return sum / static_cast<double>(particles.size());
}

/// A gauge from the particles `some` to all, and the line between their mean places.
struct Gauge {
  FakeBody body{{4, 2, 2}};
  Plugin probe;
  Vec3 line;

  explicit Gauge(nlohmann::json settings = {})
      : probe("probes.gauge", [&] {
          settings["from"] = "some";
          settings["to"] = "all";
          return settings;
        }()) {
    EXPECT_EQ(probe.begin_probe(body.context("."), body.at(0)),
              (std::vector<std::string>{"elongation", "strain"}));
    std::vector<Particle> all;
    for (Particle p = 0; p < body.positions().size() / 3; ++p) all.push_back(p);
    line = mean_place(body, all) - mean_place(body, body.some());
  }
  /// Moves every particle by move(place) and returns the elongation and the strain.
  template <class Move>
  std::vector<double> after(const Move& move) {
    const Snapshot snapshot = body.at(0);
    for (std::size_t n = 0; n < body.positions().size(); n += 3) {
      const Vec3 u =
          move(Vec3{body.positions()[n], body.positions()[n + 1], body.positions()[n + 2]});
      for (const std::size_t axis : {0U, 1U, 2U}) body.displacements[n + axis] = u[axis];
    }
    return probe.sample(snapshot, 2);
  }
};

/// Turns a vector about the axis z.
Vec3 turned(Vec3 v, double angle) {
  return {std::cos(angle) * v.x - std::sin(angle) * v.y,
          std::sin(angle) * v.x + std::cos(angle) * v.y, v.z};
}

TEST(GaugeProbe, MeasuresStretchAndNoRotation) {
  Gauge gauge;
  const double length = norm(gauge.line);
  for (const double angle : {0.0, 1e-3, 1.0, 3.0})
    for (const double strain : {0.0, 1e-9, 0.25}) {
      const auto row = gauge.after([&](Vec3 x) {
        return turned((1 + strain) * x, angle) - x + Vec3{1e-3, 0, -2e-3};
      });
      EXPECT_NEAR(row[0], strain * length, 1e-12 * length) << angle;
      EXPECT_NEAR(row[1], strain, 1e-12) << angle;
    }
}

TEST(GaugeProbe, MeasuresAlongADirection) {
  Gauge gauge(nlohmann::json{{"direction", {0.0, 0.0, 2.0}}});
  const double shear = 0.01;
  const auto row = gauge.after([&](Vec3 x) { return Vec3{1e-3, 0, shear * x.x}; });
  EXPECT_NEAR(row[0], shear * gauge.line.x, 1e-16);
  EXPECT_NEAR(row[1], shear * gauge.line.x / norm(gauge.line), 1e-12);
}

TEST(GaugeProbe, RefusesAGaugeWithoutLength) {
  FakeBody body({2, 2, 2});
  Plugin none("probes.gauge", {{"from", "all"}, {"to", "all"}});
  EXPECT_EQ(refusal(none, body), "to whose mean place is not that of the end \"from\"");
}

}  // namespace probes_test
}  // namespace hyperlattice::test
