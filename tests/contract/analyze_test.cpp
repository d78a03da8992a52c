// `hyperlattice analyze` from the command line: output for programs, refusals and their messages,
// and the files that the command writes.
#include <gtest/gtest.h>
#include <support/program.hpp>

#include <array>
#include <cmath>

namespace analyze_test {
using namespace hyperlattice;
using nlohmann::json;
using Words = std::vector<std::string>;

const std::string crystals = std::string(HYPERLATTICE_SOURCE) + "/docs/theory/data/crystals.csv";

test::Result analyze(Words words) {
  words.insert(words.begin(), "analyze");
  return test::run_program(words);
}

json read(Words words) {
  words.push_back("--json");
  const test::Result result = analyze(words);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return json::parse(result.out);
}

/// Expects exit code 2 and a message with all of the parts.
void expect_refused(const Words& words, const Words& parts) {
  const test::Result result = analyze(words);
  EXPECT_EQ(result.exit_code, 2) << testing::PrintToString(words);
  EXPECT_EQ(result.out, "");
  for (const std::string& part : parts)
    EXPECT_NE(result.err.find(part), std::string::npos) << testing::PrintToString(words) << '\n'
                                                        << result.err;
}

TEST(Analyze, SaysAllOfMembraneIm) {  // nu = 0.1: lambda = 2.8
  for (const Words& words :
       {Words{"--membrane", "I-m", "--poisson", "0.1"}, {"--membrane", "I-m", "--lambda", "2.8"}}) {
    const json found = read(words);
    const double L = 2.8, C1 = 6 + 3 * L, C2 = 2 + L, C3 = 7 * L, C4 = 3 * L;
    EXPECT_NEAR(found.at("lambda"), L, 1e-12);
    EXPECT_NEAR(found.at("C1"), C1, 1e-12);
    EXPECT_NEAR(found.at("C2"), C2, 1e-12);
    EXPECT_NEAR(found.at("C3"), C3, 1e-12);
    EXPECT_NEAR(found.at("C4"), C4, 1e-12);
    EXPECT_NEAR(found.at("C11"), (C1 - C4 * C4 / C3) / 2, 1e-12);
    EXPECT_NEAR(found.at("C44"), C2 / 2, 1e-12);
    EXPECT_NEAR(found.at("young_over_k_per_l"), 5.28, 1e-12);
    EXPECT_NEAR(found.at("poisson_bulk"), 0.1, 1e-12);
    EXPECT_NEAR(found.at("poisson_shear"), 0.1, 1e-12);
    EXPECT_NEAR(found.at("zener"), 1, 1e-12);
    EXPECT_EQ(found.at("isotropic"), true);
    EXPECT_EQ(found.at("stable").at("mirrored"), true);
    EXPECT_EQ(found.at("stable").at("two_layer"), true);
    EXPECT_TRUE(found.at("unstable").empty());
    EXPECT_NEAR(found.at("critical_time_step"), 2 / std::sqrt(14 * L), 1e-9);
  }
}

// For nu = 0.1, each membrane has these values: lambda, E l / k, A, and whether the lattice of two
// layers is stable too.
TEST(Analyze, FigureFive) {
  struct Row {
    const char* membrane;
    double lambda, eta, zener;
    bool two_layer;
  };
  for (const Row& row : {Row{"I", 2.3478, 2.0852, 1.083, true},
                         {"II", 4, 1.76, 0.5, true},
                         {"I-m", 2.8, 2.112, 1, true},
                         {"III", -1.44, 0.1408, 0.25, false},
                         {"IV", 12, 3.52, 0.25, true}}) {
    const json found = read({"--membrane", row.membrane, "--poisson", "0.1"});
    EXPECT_NEAR(found.at("lambda"), row.lambda, 5e-5) << row.membrane;
    EXPECT_NEAR(found.at("young_over_k_per_l").get<double>() / 2.5, row.eta, 5e-5) << row.membrane;
    EXPECT_NEAR(found.at("zener"), row.zener, 5e-4) << row.membrane;
    EXPECT_EQ(found.at("stable").at("mirrored"), true) << row.membrane;
    EXPECT_EQ(found.at("stable").at("two_layer"), row.two_layer) << row.membrane;
  }
}

TEST(Analyze, NamesWhatGrows) {
  const json thick = read({"--membrane", "I-m", "--lambda", "-0.1"});
  EXPECT_EQ(thick.at("stable").at("mirrored"), false);
  EXPECT_EQ(thick.at("unstable").at(0).at("lattice"), "mirrored");
  EXPECT_EQ(thick.at("unstable").at(0).at("wave_vector"), json::parse("[0.0, 0.0, 0.0]"));
  EXPECT_EQ(thick.at("unstable").at(0).at("mode").at("strain").size(), 7u);

  const json sheared = read({"--membrane", "IV", "--poisson", "0.3"});
  EXPECT_NEAR(sheared.at("poisson_bulk"), 0.3, 1e-12);
  EXPECT_EQ(sheared.at("stable").at("mirrored"), true);
  EXPECT_EQ(sheared.at("stable").at("two_layer"), false);
  ASSERT_EQ(sheared.at("unstable").size(), 1u);
  EXPECT_EQ(sheared.at("unstable").at(0).at("lattice"), "two_layer");
  EXPECT_EQ(sheared.at("unstable").at(0).at("mode").at("direction").size(), 3u);
  EXPECT_NE(
      sheared.at("unstable").at(0).at("because").get<std::string>().find("two layers oppositely"),
      std::string::npos);
}

TEST(Analyze, FreeRatiosAndNone) {
  for (const auto& [nu, K] :
       {std::pair{0.3, 0.5}, {0.4, 3.0}, {0.45, 8.0}, {0.49, 48.0}, {0.0, -1.0}, {-0.5, -1.5}}) {
    const json volumetric = read({"--membrane", "none", "--poisson", std::to_string(nu)});
    EXPECT_NEAR(volumetric.at("volumetric"), K, 1e-11) << nu;
    EXPECT_NEAR(volumetric.at("C11"), 3 + K, 1e-11) << nu;
    EXPECT_NEAR(volumetric.at("C12"), 1 + K, 1e-11) << nu;
    EXPECT_NEAR(volumetric.at("C44"), 1, 1e-12) << nu;
    EXPECT_NEAR(volumetric.at("poisson_bulk"), nu, 1e-12) << nu;
    EXPECT_TRUE(volumetric.at("isotropic")) << nu;
    EXPECT_TRUE(volumetric.at("stable").at("mirrored")) << nu;
    if (K > 0) {
      EXPECT_NEAR(volumetric.at("critical_time_step"), 2 / std::sqrt(12 + 4 * K), 1e-9) << nu;
    }
  }
  const json none = read({"--membrane", "none"});
  EXPECT_NEAR(none.at("poisson_bulk"), 0.25, 1e-12);
  EXPECT_NEAR(none.at("critical_time_step"), 2 / std::sqrt(12.0), 1e-9);
  // A stable choice beyond nu = 1/4: k_beta = 0, k_gamma = 3, clamped.
  const json free =
      read({"--membrane", "free", "--k_alpha", "infinite", "--k_beta", "0", "--k_gamma", "3"});
  EXPECT_EQ(free.at("k_alpha"), "infinite");
  EXPECT_NEAR(free.at("poisson_bulk"), 0.3, 1e-12);
  EXPECT_NEAR(free.at("zener"), 1.5, 1e-12);
  EXPECT_EQ(free.at("stable").at("two_layer"), true);
  const json negative =
      read({"--membrane", "free", "--k_alpha", "-1", "--k_beta", "2", "--k_gamma", "1.5"});
  EXPECT_NEAR(negative.at("C3"), 11, 1e-12);
}

TEST(Analyze, PeopleReadTheSame) {
  const std::string page = analyze({"--membrane", "IV", "--lambda", "-1"}).out;
  for (const char* part :
       {"nu'", "0.285714", "Zener ratio A", "mirrored lattice             stable",
        "two-layer lattice            unstable: the wave", "critical time step"})
    EXPECT_NE(page.find(part), std::string::npos) << part << '\n' << page;
}

TEST(Analyze, RefusesPoissonRatiosOutOfReach) {
  expect_refused({"--membrane", "I-m", "--poisson", "0.3"},
                 {"--poisson", "0.3", "within (-0.2, 0.25], the reach of membrane I-m",
                  "0.3 is within the reach of IV (not isotropic)"});
  expect_refused({"--membrane", "I", "--poisson", "-0.3"},
                 {"within (-0.2119, 0.25], the reach of membrane I",
                  "-0.3 is within the reach of II (not isotropic)"});
  expect_refused(
      {"--membrane", "II", "--poisson", "0.26"},
      {"within (-0.5, 0.25]", "within the reach of III (not isotropic), IV (not isotropic)"});
  expect_refused(
      {"--membrane", "III", "--poisson", "0.27"},
      {", 0.2667), the reach of membrane III", "within the reach of IV (not isotropic)"});
  expect_refused({"--membrane", "IV", "--poisson", "0.34"},
                 {", 0.3333), the reach of membrane IV", "membrane none reaches it"});
  expect_refused({"--membrane", "I-m", "--poisson", "-0.2"},
                 {"-0.2 is within the reach of I (not isotropic), II (not isotropic)"});
  expect_refused({"--membrane", "none", "--poisson", "0.5"}, {"--poisson", "none, or 0.25"});
  expect_refused({"--membrane", "free", "--k_beta", "1", "--k_alpha", "1", "--poisson", "0.2"},
                 {"--poisson", "that is what these springs have"});
  EXPECT_EQ(analyze({"--membrane", "I-m", "--poisson", "0.25"}).exit_code, 0);
}

// E l / k of the centred lattices is 5/3 and 5/2 without a membrane; a membrane multiplies it by
// eta.
TEST(Analyze, CentredLattices) {
  for (const auto& [lattice, young] : {std::pair{"lattices.bcc", 5.0 / 3}, {"lattices.fcc", 2.5}}) {
    EXPECT_NEAR(read({"--lattice", lattice, "--membrane", "none"}).at("young_over_k_per_l"), young,
                1e-12);
    const json found = read({"--lattice", lattice, "--membrane", "I-m", "--poisson", "0.1"});
    EXPECT_NEAR(found.at("poisson_bulk"), 0.1, 1e-12);
    EXPECT_EQ(found.at("isotropic"), true);
    EXPECT_EQ(found.at("stable").at("two_layer"), true);
  }
  expect_refused(
      {"--lattice", "lattices.fcc", "--membrane", "IV", "--poisson", "0.45"},
      {"within (0, 0.3333), the reach of membrane IV", "0.45 is within the reach of III"});
  expect_refused({"--lattice", "lattices.bcc", "--membrane", "I-m", "--poisson", "0.3"},
                 {"within (-0.35, 0.25], the reach of membrane I-m"});
}

// Each curve ends at half of the shortest reciprocal vector along its direction, where it turns
// back.
TEST(Analyze, DispersionOfCentredLatticesRunsToTheirOwnZone) {
  const test::Folder folder("dispersion");
  const std::string file = folder.file("curves.csv");
  for (const auto& [lattice, ends] :
       {std::pair{"lattices.bcc", std::array{2, 1, 2}}, {"lattices.fcc", {2, 2, 1}}}) {
    read({"--lattice", lattice, "--membrane", "none", "--dispersion", file});
    const std::vector<std::string> rows = test::table_rows(file);
    ASSERT_EQ(rows.size(), 303u);
    for (std::size_t n = 0; n < 3; ++n) {
      const std::string& last = rows[101 * n + 100];
      EXPECT_NEAR(std::stod(last.substr(last.find(',') + 1)), ends[n] * std::acos(-1.0), 1e-6)
          << last;
    }
  }
}

TEST(Analyze, RefusesWhatDoesNotFitTogether) {
  expect_refused({}, {"--membrane", "none, I, II, III, IV, I-m or free"});
  expect_refused({"--membrane", "I_m", "--poisson", "0.1"},
                 {"--membrane", "I_m", "did you mean 'I-m'"});
  expect_refused({"--membrane", "I-m"}, {"--poisson", "or --lambda in its place"});
  expect_refused({"--membrane", "I-m", "--poisson", "0.1", "--lambda", "2"},
                 {"--lambda", "each follows from the other"});
  expect_refused({"--membrane", "none", "--lambda", "2"},
                 {"--lambda", "only membranes I, II, III, IV and I-m"});
  expect_refused({"--membrane", "I", "--lambda", "2", "--k_beta", "1", "--k_gamma", "1"},
                 {"--k_beta", "--k_gamma", "--membrane free"});
  expect_refused({"--membrane", "free", "--k_alpha", "endless"},
                 {"--k_alpha", "endless", "or infinite"});
  expect_refused({"--membrane", "I", "--lambda", "nan"}, {"--lambda", "a finite number"});
  expect_refused({"--membrane", "free", "--k_beta", "inf"}, {"--k_beta", "a finite number"});
  expect_refused({"--membrane", "I", "--lambda", "much"}, {"--lambda"});
  expect_refused({"--lambda", "1", "--plot", "map.svg"}, {"--membrane"});
  expect_refused({"--lattice", "lattices.qubic", "--membrane", "none"},
                 {"--lattice", "lattices.qubic", "did you mean 'lattices.cubic'"});
  expect_refused({"--lattice", "loads.fixed", "--membrane", "none"},
                 {"--lattice", "loads.fixed", "a lattice that can be found"});
  expect_refused({"--lattice", "lattices.other", "--crystals", crystals},
                 {"--lattice", "lattices.cubic"});
}

TEST(Analyze, WritesDispersionCurves) {
  const test::Folder folder("dispersion");
  const std::string file = folder.file("curves.csv");
  read({"--membrane", "I-m", "--poisson", "0.1", "--dispersion", file});
  EXPECT_TRUE(test::contents(file).starts_with(
      "direction,q_x,q_y,q_z,mirrored_1,mirrored_2,mirrored_3,mirrored_4,opposed_1,"));
  EXPECT_EQ(test::table_rows(file).size(), 303u);
  EXPECT_EQ(
      analyze({"--membrane", "none", "--dispersion", folder.file("nowhere/curves.csv")}).exit_code,
      4);
}

TEST(Analyze, CountsTheCrystals) {
  const json found = read({"--crystals", crystals});
  const json& counts = found.at("crystal_counts");
  EXPECT_EQ(counts.at("all"), 116);
  EXPECT_EQ(counts.at("in_display_range"), 115);
  EXPECT_EQ(counts.at("fit"), 115);
  EXPECT_EQ(counts.at("stable_mirrored"), 36);
  const json& silver = found.at("crystals").at(0);
  EXPECT_EQ(silver.at("name"), "Ag");
  EXPECT_EQ(silver.at("fit").at("stable").at("mirrored"), false);
  EXPECT_NE(analyze({"--crystals", crystals})
                .out.find("Of 116 crystals, 115 are in the window of figure 4, 115 have a lattice, "
                          "36 a stable one"),
            std::string::npos);
}

TEST(Analyze, RefusesBadTablesLineByLine) {
  const test::Folder folder("crystals");
  const std::string file = folder.file("table.csv");
  expect_refused({"--crystals", folder.file("none.csv")}, {"none.csv", "there is no such file"});
  std::ofstream(file) << "name,C11_GPa,C44_GPa\nX,3,1\n";
  expect_refused({"--crystals", file}, {"table.csv:1", "a column C12_GPa"});
  std::ofstream(file) << "name,C11_GPa,C12_GPa,C44_GPa\nX,3,one,1\nY,3\nZ,1,2,1\n";
  expect_refused({"--crystals", file}, {"table.csv:2", "a number in column C12_GPa", "table.csv:3",
                                        "table.csv:4", "C11 > C12"});
  std::ofstream(file) << "name,C11_GPa,C12_GPa,C44_GPa\n";
  expect_refused({"--crystals", file}, {"at least one crystal"});
}

TEST(Analyze, DrawsTheMap) {
  const test::Folder folder("map");
  const std::string file = folder.file("figure 4's.svg");
  const test::Result result =
      analyze({"--membrane", "I-m", "--poisson", "0.1", "--crystals", crystals, "--plot", file});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string picture = test::contents(file);
  EXPECT_NE(picture.find("<svg"), std::string::npos);
  EXPECT_NE(picture.find("</svg>"), std::string::npos);
  EXPECT_NE(picture.find("crystals, stable lattice"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(file + ".part"));
}

TEST(Analyze, SaysThatGnuplotIsMissing) {
  const test::Folder folder("no_gnuplot");
  test::Launch launch;
  static std::string path = "PATH=/nowhere";
  launch.environment = {path};
  const test::Result result =
      test::run_program({"analyze", "--plot", folder.file("map.svg")}, launch);
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_NE(result.err.find("gnuplot is not installed (Debian's package gnuplot-nox)"),
            std::string::npos)
      << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder.file("map.svg")));
}

}  // namespace analyze_test
