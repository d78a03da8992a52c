// `hyperlattice calibrate` from the command line: output for programs, refusals and their messages,
// and the picture.
#include <gtest/gtest.h>
#include <support/program.hpp>

namespace calibrate_command_test {
using namespace hyperlattice;
using nlohmann::json;
using Words = std::vector<std::string>;

test::Result calibrate(Words words) {
  words.insert(words.begin(), "calibrate");
  return test::run_program(words);
}

json read(Words words) {
  words.push_back("--json");
  const test::Result result = calibrate(words);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return json::parse(result.out);
}

/// Expects exit code 2, a message with all of the parts, and exactly `faults` faults.
void expect_refused(const Words& words, const Words& parts, std::ptrdiff_t faults = 1) {
  const test::Result result = calibrate(words);
  EXPECT_EQ(result.exit_code, 2) << testing::PrintToString(words);
  EXPECT_EQ(result.out, "");
  for (const std::string& part : parts)
    EXPECT_NE(result.err.find(part), std::string::npos) << testing::PrintToString(words) << '\n'
                                                        << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1 + faults) << result.err;
}

TEST(CalibrateCommand, FromEAndNuToSprings) {
  const json found =
      read({"--membrane", "I-m", "--young", "10e9", "--poisson", "0.1", "--spacing", "1e-3"});
  EXPECT_EQ(found.at("lattice"), "lattices.cubic");
  EXPECT_EQ(found.at("membrane"), "I-m");
  EXPECT_EQ(found.at("parameters"), "closed_form");
  EXPECT_NEAR(found.at("lambda"), 2.8, 1e-12);
  EXPECT_NEAR(found.at("eta"), 2.112, 1e-12);
  EXPECT_NEAR(found.at("zener"), 1, 1e-12);
  EXPECT_NEAR(found.at("poisson"), 0.1, 1e-12);
  EXPECT_NEAR(found.at("base_stiffness_per_spacing"), 10e9 / 5.28, 1);
  EXPECT_NEAR(found.at("base_stiffness"), 10e6 / 5.28, 1e-3);
  EXPECT_NEAR(found.at("k_gamma"), 2.1, 1e-12);
  EXPECT_FALSE(found.contains("measured"));
}

TEST(CalibrateCommand, FromSpringsToNu) {
  const json found = read({"--membrane", "IV", "--lambda", "12"});
  EXPECT_NEAR(found.at("poisson"), 0.1, 1e-12);
  EXPECT_NEAR(found.at("eta"), 3.52, 1e-12);
  EXPECT_NEAR(found.at("zener"), 0.25, 1e-12);
  EXPECT_EQ(found.at("k_alpha"), "infinite");
  EXPECT_FALSE(found.contains("base_stiffness_per_spacing"));
  EXPECT_NEAR(read({"--membrane", "IV", "--lambda", "12", "--young", "1e9"})
                  .at("base_stiffness_per_spacing"),
              1e9 / (2.5 * 3.52), 1e-3);
}

TEST(CalibrateCommand, NoneAndFree) {
  const json none = read({"--membrane", "none", "--young", "1e9"});
  EXPECT_NEAR(none.at("poisson"), 0.25, 1e-12);
  EXPECT_NEAR(none.at("base_stiffness_per_spacing"), 0.4e9, 1e-3);
  const json free = read({"--membrane", "free", "--k_alpha", "infinite", "--k_gamma", "3",
                          "--measure", "6", "--strain", "1e-6"});
  EXPECT_NEAR(free.at("poisson"), 0.3, 1e-12);
  EXPECT_FALSE(free.contains("lambda"));
  EXPECT_NEAR(free.at("measured").at("poisson"), 0.3, 0.01);
}

TEST(CalibrateCommand, Measures) {  // value of the independent table, 10^3
  const json found =
      read({"--membrane", "I-m", "--lambda", "2", "--measure", "10", "--strain", "1e-6"});
  EXPECT_NEAR(found.at("measured").at("poisson"), 0.129713, 2e-6);
  EXPECT_NEAR(found.at("measured").at("modulus_ratio"), 1.803049, 4e-6);
  EXPECT_NEAR(found.at("infinite").at("poisson"), 0.131579, 1e-6);
  EXPECT_EQ(found.at("measured").at("particles_along_edge"), 10);
  EXPECT_EQ(found.at("measured").at("strain"), 1e-6);
  EXPECT_LE(found.at("measured").at("residual"), 1e-6);
  EXPECT_GT(found.at("measured").at("seconds"), 0);
}

TEST(CalibrateCommand, PeopleReadTheSame) {
  const std::string page =
      calibrate({"--membrane", "I-m", "--young", "10e9", "--poisson", "0.1", "--measure", "6"}).out;
  for (const char* part : {"lambda                       2.8", "modulus ratio eta            2.112",
                           "base stiffness k / l         1.89394e+09 Pa",
                           "Measured on 6 x 6 x 6 particles, strain 0.001"})
    EXPECT_NE(page.find(part), std::string::npos) << part << '\n' << page;
}

TEST(CalibrateCommand, CentredLattices) {
  for (const auto& [lattice, cell] : {std::pair{"lattices.bcc", "4 x 4 x 4 cells of 2 particles"},
                                      {"lattices.fcc", "4 x 4 x 4 cells of 4 particles"}}) {
    const json found = read({"--lattice", lattice, "--membrane", "I-m", "--poisson", "0.1",
                             "--young", "1e9", "--measure", "4"});
    const json back = read({"--lattice", lattice, "--membrane", "I-m", "--lambda",
                            std::to_string(found.at("lambda").get<double>())});
    EXPECT_NEAR(back.at("poisson"), 0.1, 1e-6);
    EXPECT_NEAR(found.at("zener"), 1, 1e-12);
    // The surface dominates a small cube.
    EXPECT_NEAR(found.at("measured").at("poisson"), 0.1, 0.05);
    const std::string page =
        calibrate({"--lattice", lattice, "--membrane", "I-m", "--poisson", "0.1", "--measure", "4"})
            .out;
    EXPECT_NE(page.find(cell), std::string::npos) << page;
  }
  expect_refused({"--lattice", "lattices.fcc", "--membrane", "I-m", "--poisson", "0.1",
                  "--parameters", "paper"},
                 {"--parameters", "the simple cubic lattice"});
}

TEST(CalibrateCommand, RefusesWhatIsOutOfReach) {
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
  expect_refused({"--lattice", "lattices.fcc", "--membrane", "none", "--poisson", "0.2"},
                 {"--poisson", "none, or 0.25"});
  expect_refused({"--membrane", "none", "--poisson", "0.5"}, {"--poisson", "none, or 0.25"});
  for (const char* membrane : {"I-m", "I", "II"})
    expect_refused(
        {"--membrane", membrane, "--lambda", "-1"},
        {"--lambda", "at least 0: with less, membrane", "is unstable; -1 is stable with III, IV"});
  expect_refused({"--membrane", "III", "--lambda", "-1.5"},
                 {"above -1.5", "-1.5 is stable with IV"});
  expect_refused({"--membrane", "IV", "--lambda", "-2"},
                 {"above -2: with less, membrane IV is unstable; no membrane of this lattice is "
                  "stable with it"});
  expect_refused({"--membrane", "free", "--k_alpha", "1", "--k_beta", "-3"},
                 {"--membrane", "springs that make a stable lattice", "grows"});
  EXPECT_EQ(calibrate({"--membrane", "IV", "--lambda", "-1.99"}).exit_code, 0);
  EXPECT_EQ(calibrate({"--membrane", "I-m", "--lambda", "0"}).exit_code, 0);
}

TEST(CalibrateCommand, RefusesWhatThePolynomialsDoNotCover) {
  const Words paper = {"--parameters", "paper"};
  const auto with = [&](Words words) {
    words.insert(words.end(), paper.begin(), paper.end());
    return words;
  };
  EXPECT_EQ(calibrate(with({"--membrane", "I-m", "--poisson", "0.04"})).exit_code, 0);
  EXPECT_EQ(calibrate(with({"--membrane", "I-m", "--lambda", "0"})).exit_code, 0);
  expect_refused(with({"--membrane", "I-m", "--poisson", "0.039"}),
                 {"0.04 to 0.2464", "--parameters closed_form takes it"});
  expect_refused(with({"--membrane", "I-m", "--poisson", "0.3"}),
                 {"0.04 to 0.2464", "0.3 is within the reach of IV (not isotropic)"});
  expect_refused(with({"--membrane", "I-m", "--lambda", "5"}),
                 {"--lambda", "0 to 4.959", "--parameters closed_form takes it"});
  expect_refused(with({"--membrane", "I-m", "--lambda", "-1"}),
                 {"0 to 4.959", "-1 is stable with III, IV"});
  expect_refused(with({"--membrane", "I", "--poisson", "0.1"}),
                 {"--parameters", "closed_form", "membrane I-m"});
  expect_refused({"--membrane", "I-m", "--poisson", "0.1", "--parameters", "papper"},
                 {"did you mean 'paper'"});
}

TEST(CalibrateCommand, RefusesWhatDoesNotFitTogether) {
  expect_refused({}, {"--membrane", "one of none, I, II, III, IV, I-m, free"});
  expect_refused({"--membrane", "I-m"}, {"--poisson", "or --lambda in its place"});
  expect_refused({"--membrane", "I-m", "--poisson", "0.1", "--lambda", "2"},
                 {"--lambda", "each follows from the other"});
  expect_refused({"--membrane", "I-m", "--poisson", "0.1", "--young", "-1"},
                 {"--young", "a positive, finite number"});
  expect_refused({"--membrane", "I-m", "--poisson", "0.1", "--spacing", "1"},
                 {"--spacing", "--young with it"});
  expect_refused({"--membrane", "I-m", "--poisson", "0.3", "--young", "nan"},
                 {"--young", "not a finite number"});  // the message also leads to the help
  expect_refused({"--membrane", "I-m", "--lambda", "1", "--measure", "2"},
                 {"--measure", "3 to 500"});
  expect_refused({"--membrane", "I-m", "--lambda", "1", "--strain", "1e-3"},
                 {"--strain", "--measure with it"});
  expect_refused({"--membrane", "I-m", "--lambda", "1", "--measure", "4", "--strain", "0.5"},
                 {"--strain", "0.5", "1e-9 to 0.1"});
  expect_refused({"--membrane", "I-m", "--lambda", "1", "--plot", "figure.svg"},
                 {"--plot", "--curve with it"});
  expect_refused({"--membrane", "I-m", "--lattice", "lattices.qubic"},
                 {"--lattice", "did you mean 'lattices.cubic'"});
}

TEST(CalibrateCommand, RefusesCurvesThatAreNone) {
  expect_refused({"--membrane", "none", "--curve", "0", "4", "10"},
                 {"--membrane", "I, II, III, IV or I-m"});
  expect_refused({"--membrane", "I-m", "--curve", "4", "0", "10"}, {"--curve", "FROM below TO"});
  expect_refused({"--membrane", "I-m", "--curve", "0", "inf", "10"}, {"--curve", "FROM below TO"});
  expect_refused({"--membrane", "I-m", "--curve", "0", "4", "3"}, {"--curve", "4 to 10000 points"});
  expect_refused({"--membrane", "III", "--curve", "-1.8", "4", "10"},
                 {"--curve", "FROM above -1.5", "-1.8 is stable with IV"}, 1);
  expect_refused(
      {"--membrane", "I-m", "--curve", "0", "4", "10", "--poisson", "0.1", "--young", "1"},
      {"--poisson", "--young", "many lambda"}, 2);
}

TEST(CalibrateCommand, FigureTwo) {
  const test::Folder folder("figure_2");
  const std::string file = folder.file("figure 2.svg");
  const json found =
      read({"--membrane", "I-m", "--curve", "0", "4.5", "10", "--measure", "6", "--plot", file});
  ASSERT_EQ(found.at("points").size(), 10u);
  EXPECT_EQ(found.at("points").at(9).at("lambda"), 4.5);
  EXPECT_NEAR(found.at("points").at(2).at("infinite").at("poisson"), 0.181818, 1e-6);
  EXPECT_EQ(found.at("points").at(0).at("measured").at("modulus_ratio"), 1.0);
  EXPECT_EQ(found.at("fit").at("of"), "measured");
  EXPECT_EQ(found.at("fit").at("lambda_of_poisson").size(), 4u);
  EXPECT_EQ(found.at("fit").at("modulus_ratio_of_lambda").size(), 3u);
  EXPECT_EQ(found.at("paper").at("lambda_of_poisson").at(0), -211.13493779);
  EXPECT_NE(test::contents(file).find("</svg>"), std::string::npos);

  const test::Result endless = calibrate({"--membrane", "IV", "--curve", "-1.5", "5", "14"});
  EXPECT_EQ(endless.exit_code, 0) << endless.err;
  EXPECT_NE(endless.out.find("Membrane IV: the infinite lattice"), std::string::npos)
      << endless.out;
  EXPECT_EQ(endless.out.find("the paper"), std::string::npos);
}

}  // namespace calibrate_command_test
