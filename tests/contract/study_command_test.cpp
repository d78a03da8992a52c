// `hyperlattice study` from the command line: output for programs, refusals and their messages.
#include <gtest/gtest.h>
#include <support/study.hpp>

namespace study_command_test {
using namespace hyperlattice::test;
using nlohmann::json;
using Words = std::vector<std::string>;
namespace fs = std::filesystem;

// Without a truth the study shows the values of the runs: those of the exact motion.
TEST_F(StudyCommand, ShowsValuesWithoutATruth) {
  json file = swinging_pair();
  file.erase("truth");
  file.erase("repeats");
  file["compare"]["largest"] = {
      {"probe", "upper"}, {"column", "displacement_z"}, {"reduce", "max"}};
  const Result result = study(file, {"--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json found = json::parse(result.out);
  ASSERT_EQ(found.at("rows").size(), 6u);
  EXPECT_TRUE(found["norm"].is_null());
  for (const json& row : found["rows"]) {
    EXPECT_TRUE(row.at("error").is_null());
    EXPECT_EQ(row.at("repeats").size(), 1u) << "nothing is timed";
    const double exact = swing(row["stiffness"] == "stiff" ? 10e9 : 5e9);
    // Central differences are of second order: 0.35 % at a step of 0.2 us.
    const double steps = row["size"].get<double>() / 0.2e-6;
    EXPECT_NEAR(row.at("values").at("upper"), exact, 0.005 * steps * steps * std::abs(exact));
    EXPECT_GE(row["values"]["largest"], row["values"]["upper"]);
  }
  EXPECT_TRUE(found["orders"].empty());
  std::ifstream table(out() + "/study.csv");
  std::string heading;
  std::getline(table, heading);
  EXPECT_EQ(heading, "step,stiffness,largest,upper,particles,steps,seconds,setup_seconds,status");
  EXPECT_NE(study(file).out.find("upper"), std::string::npos);
}

TEST_F(StudyCommand, RefusesWhatNeedsATruth) {
  json file = swinging_pair();
  file.erase("truth");
  file["target_error"] = 0.01;
  file["compare"]["upper"]["scale"] = 2;
  expect_refused(
      file, {"/target_error: 0.01: expected \"truth\" with it: a study without a truth has no "
             "errors",
             "/compare/upper/scale: 2: expected nothing here, because the study has no truth"});
}

TEST_F(StudyCommand, GivesRowsOrdersAndTheCheapestSetting) {
  const Result result = study(true_swinging_pair(), {"--json", "--target-error", "0.5%"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json found = json::parse(result.out);
  ASSERT_EQ(found.at("rows").size(), 6u);
  for (const json& row : found["rows"]) {
    for (const char* key : {"step", "stiffness", "error", "seconds", "particles", "steps", "size",
                            "pareto", "run", "status"})
      EXPECT_TRUE(row.contains(key)) << key;
    EXPECT_EQ(row["particles"], 2);
    EXPECT_EQ(row["status"], "done");
    EXPECT_GT(row["seconds"], 0);
    EXPECT_TRUE(fs::exists(out() + "/" + row["run"].get<std::string>() + "/summary.json"));
  }
  EXPECT_EQ(found["rows"][0]["step"], "0.2 us");
  EXPECT_EQ(found["rows"][0]["stiffness"], "stiff");
  EXPECT_NEAR(found["rows"][0]["size"], 0.2e-6, 1e-18);
  ASSERT_EQ(found.at("orders").size(), 2u);
  EXPECT_EQ(found["orders"][0]["stiffness"], "stiff");
  EXPECT_EQ(found["orders"][1]["stiffness"], "soft");
  for (const json& order : found["orders"]) {
    EXPECT_NEAR(order["order"], 2, 0.05) << "central differences are of second order";
    EXPECT_EQ(order["pairs"].size(), 2u);
  }
  ASSERT_TRUE(found.at("cheapest").is_object());
  EXPECT_LE(found["cheapest"]["error"], 0.005);
  for (const json& row : found["rows"])
    if (row["error"] <= 0.005) {
      EXPECT_LE(found["cheapest"]["seconds"], row["seconds"]);
    }
  EXPECT_EQ(read_json(out() + "/study.json"), found);
  EXPECT_EQ(table_rows(out() + "/study.csv").size(), 6u);
  EXPECT_NE(contents(out() + "/study.svg").find("Swinging pair"), std::string::npos);
}

TEST_F(StudyCommand, VariesVariablesOfASceneWithIncludedFiles) {
  json file = true_swinging_pair();
  json included = file["scene"], scene{{"include", "parts/pair.json"}};
  included["pipeline"][4]["time_step"] = "${step} * 2";
  included["variables"] = {{"step", "1 us"}};
  fs::create_directories(folder_.file("parts"));
  std::ofstream(folder_.file("parts/pair.json")) << included.dump();
  std::ofstream(folder_.file("scene.json")) << scene.dump();
  file["$schema"] = "study.schema.json";
  file["scene"] = "scene.json";
  file["vary"]["step"] = {{"/variables/step", {"0.1 us", "0.05 us", "0.025 us"}}};
  const Result result = study(file, {"--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json found = json::parse(result.out);
  EXPECT_NEAR(found["rows"][0]["size"], 0.1e-6, 1e-18);
  for (const json& order : found["orders"]) EXPECT_NEAR(order["order"], 2, 0.05);

  fs::remove_all(out());
  file["vary"]["step"] = {{"/variables/stp", {"0.1 us", "0.05 us"}}};
  expect_refused(file, {"variables/stp (run step-0.1us", "variables/stp (run step-0.05us"});
  file["$schema"] = 1;
  EXPECT_NE(study(file).err.find("/$schema: 1: expected"), std::string::npos);
}

TEST_F(StudyCommand, TheCheapestSettingDoesForAllCases) {
  json file = true_swinging_pair();
  file["cases"] = {"stiffness"};
  const Result result = study(file, {"--json", "--target-error", "0.5%"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json found = json::parse(result.out);
  ASSERT_TRUE(found.at("cheapest").is_object());
  for (const json& row : found["rows"])
    if (row["step"] == found["cheapest"]["step"]) {
      EXPECT_LE(row["error"], found["cheapest"]["error"]);
    }
  EXPECT_LE(found["cheapest"]["error"], 0.005);
  EXPECT_NE(found["sentence"].get<std::string>().find(" at most, with stiffness "),
            std::string::npos)
      << found["sentence"];
}

TEST_F(StudyCommand, RefusesACaseThatIsNoAxis) {
  json file = true_swinging_pair();
  file["cases"] = {"stifness"};
  expect_refused(file, {"/cases/0"});
}

TEST_F(StudyCommand, CountsQuantitiesTogether) {
  json file = swinging_pair();
  file["scene"]["pipeline"][5].erase("component");
  // Zero alone has no relative error.
  file["truth"] = {{"values", {{"along", 1.5 * swing(10e9)}, {"across", 0}}}};
  file["compare"] = {
      {"along", {{"probe", "upper"}, {"column", "displacement_z"}, {"truth", "along"}}},
      {"across", {{"probe", "upper"}, {"column", "displacement_x"}, {"truth", "across"}}}};
  file["vary"]["step"]["/pipeline/4/time_step"] = {"0.05 us"};
  file["vary"].erase("stiffness");
  expect_refused(file,
                 {"/truth/values/across: 0: expected a truth of \"across\" that is not zero"});
  file["error"] = "together_l2";
  const Result result = study(file, {"--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json row = json::parse(result.out).at("rows").at(0);
  EXPECT_NEAR(row["error"], 1.0 / 3, 1e-3);
  EXPECT_NEAR(row["errors"]["along"], 1.0 / 3, 1e-3);
  EXPECT_EQ(row["errors"]["across"], 0);
}

/// If the steps seem to give an order above two, the runs are done and get no error.
TEST_F(StudyCommand, QuotesNoErrorFromAnOrderThatTheMethodCannotHave) {
  json file = swinging_pair();
  file["vary"].erase("stiffness");
  file["truth"] = "finest";
  file["vary"]["step"]["/start"] = {{0, 0, "1.9 mm/s"}, {0, 0, "1 mm/s"}, {0, 0, "0.999 mm/s"}};
  std::string text = file.dump(1);
  // The size comes first in the file, then the key of the start velocity.
  text.replace(text.find("/start"), 6, "/pipeline/3/linear");
  std::ofstream(folder_.file("study.json")) << text;
  const Result result =
      run_program({"study", folder_.file("study.json"), "--out", out(), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json found = json::parse(result.out);
  for (const json& row : found["rows"]) {
    EXPECT_EQ(row["status"], "done");
    EXPECT_TRUE(row["error"].is_null());
    EXPECT_NE(row["reason"].get<std::string>().find("more than the method can have"),
              std::string::npos)
        << row["reason"];
  }
  EXPECT_TRUE(found["orders"].empty());
}

TEST_F(StudyCommand, ComparesTheLimitsOfSettingsThatAnswerTheSame) {
  json file = swinging_pair();
  file["truth"] = "finest";
  // Stiff and soft count as settings, and they have different limits.
  const json found = json::parse(study(file, {"--json"}).out);
  ASSERT_EQ(found["limits"].size(), 1u);
  EXPECT_EQ(found["limits"][0]["of"]["stiffness"], "soft");
  EXPECT_EQ(found["limits"][0]["against"]["stiffness"], "stiff");
  EXPECT_NEAR(found["limits"][0]["apart"], std::abs(swing(5e9) / swing(10e9) - 1), 1e-3);
  EXPECT_NE(study(file, {"--target-error", "5%"}).out.find("says nothing of the truth"),
            std::string::npos);
  file["cases"] = {"stiffness"};  // the stiffness is now a case
  EXPECT_TRUE(json::parse(study(file, {"--json"}).out)["limits"].empty());
}

TEST_F(StudyCommand, ReadsOnlyRegularFiles) {
  json file = true_swinging_pair();
  file["scene"] = "/dev/zero";
  expect_refused(file, {"/scene: "});
  file = true_swinging_pair();
  file["peers"] = {"/dev/zero"};
  expect_refused(file, {"/peers/0: "});
  file["peers"] = json::array();
  file["truth"] = {{"csv", "/dev/zero"}};
  file["compare"]["upper"]["truth"] = "u";
  expect_refused(file, {"/truth/csv: "});
}

/// Titles, labels and names are data with any content, and the user's gnuplot files have no effect.
TEST_F(StudyCommand, DrawsTextsAsTheyStand) {
  const std::string ran = folder_.file("ran"), wild = "a `touch " + ran + "` $(touch " + ran +
                                                      ") 'b' ''i'' \"c\" @d {e}_f^g \\n <h> & #";
  std::ofstream(folder_.file(".gnuplot"))
      << "set xlabel 'hijacked'\nsystem(\"touch " << ran << "\")\n";
  std::ofstream(folder_.file("peers.csv")) << "label,error,seconds\nP " << wild << ",0.1,0.01\n";
  json file = true_swinging_pair();
  file["title"] = "T " + wild + "\nsecond line" + std::string(1, '\0') + "end\n'quoted' \x1b[31m\a";
  file["vary"]["stiffness"]["labels"] = {"L " + wild, "soft"};
  file["truth"] = {{"value", swing(10e9)}};
  std::ofstream(folder_.file("study.json")) << file.dump(1);
  Launch launch;
  launch.environment = {"HOME=" + folder_.path(), "TMPDIR=/nowhere"};
  const Result result = run_program(
      {"study", folder_.file("study.json"), "--out", out(), "--peers", folder_.file("peers.csv")},
      launch);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_FALSE(fs::exists(ran));
  const std::string picture = contents(out() + "/study.svg");
  for (const std::string letter : {"T", "L", "P"})
    EXPECT_NE(picture.find(letter + " a `touch " + ran + "` $(touch " + ran +
                           ") 'b' ''i'' \"c\" @d {e}_f^g \\n &lt;h> &amp; #"),
              std::string::npos)
        << letter << picture.substr(0, 20000);
  EXPECT_NE(picture.find(">second line"), std::string::npos);
  EXPECT_NE(picture.find(">'quoted'"), std::string::npos);
  EXPECT_EQ(result.out.find_first_of("\x1b\a"), std::string::npos);
  EXPECT_NE(result.out.find("'quoted' U+001B[31mU+0007\n"), std::string::npos) << result.out;
  EXPECT_EQ(picture.find("hijacked"), std::string::npos);
}

TEST_F(StudyCommand, RefusesTablesThatSayNotWhatIsMeant) {
  json file = swinging_pair();
  file["truth"] = {{"csv", "truth.csv"}};
  file["compare"]["upper"]["truth"] = "u";
  const auto refused = [&](const std::string& table, const Words& parts) {
    std::ofstream(folder_.file("truth.csv"), std::ios::binary) << table;
    expect_refused(file, parts);
  };
  refused("t,u\n0,0\n0,5,1,5\n1\n",
          {"/truth/csv: truth.csv, line 3: expected a row of at most 2 cells, one a column, not of "
           "4 (decimal commas?",
           "/truth/csv: truth.csv, line 4: expected a row of 2 cells, not of 1"});
  refused("t,u,u\n0,0,1\n", {"/truth/csv: truth.csv: expected one column \"u\", not several"});
  refused("t,u,U,U \n0,0,1,1\n", {"/truth/csv: truth.csv: expected one column \"U\", not several"});
  refused("t,U,v\n0,1,1\n1e-6,nan,1\n",
          {"line 3: expected a finite number in column \"U\", not \"nan\""});
  refused(std::string("\xFF\xFEt\0,\0u\0\n\0", 10),
          {"/truth/csv: truth.csv: expected a table; it is a text in UTF-16: save it in ASCII or "
           "UTF-8"});
  file["truth"] = {{"csv", "truth.csv"}, {"where", {{"nu", 1}}}};
  refused("t,u,Nu,NU\n0,1,1,1\n", {"/truth/where/nu: \"nu\": expected one column of truth.csv, and "
                                   "several differ from it in capital letters only"});
  file = swinging_pair();
  file["peers"] = {"peers.csv"};
  std::ofstream(folder_.file("peers.csv")) << "label,error,seconds\nA,0,1,2\n";
  expect_refused(file, {"/peers/0: peers.csv, line 2: expected a row of at most 3 cells"});
}

TEST_F(StudyCommand, TakesThreadsAndTheFinestRun) {
  json file = swinging_pair();
  file["vary"] = {{"step", file["vary"]["step"]}, {"threads", {1, 2}}};
  file["truth"] = "finest";
  const Result result = study(file, {"--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json found = json::parse(result.out);
  ASSERT_EQ(found["rows"].size(), 6u);
  EXPECT_EQ(found["rows"][0]["threads"], 1);
  EXPECT_EQ(found["rows"][1]["threads"], 2);
  EXPECT_EQ(found["rows"][0]["error"], found["rows"][1]["error"]) << "the threads change no bit";
  EXPECT_EQ(read_json(out() + "/" + found["rows"][1]["run"].get<std::string>() +
                      "/summary.json")["threads"],
            2);
  // The limit extrapolated from the runs agrees with the closed form, one order better than the
  // runs do.
  const double finest = std::abs(found["rows"][4]["error"].get<double>());
  file["truth"] = {{"value", swing(10e9)}};
  const json against_truth = json::parse(study(file, {"--json"}).out);
  EXPECT_NEAR(against_truth["rows"][4]["error"], finest, 0.05 * finest);
}

TEST_F(StudyCommand, ARunThatFailsIsARow) {
  json file = true_swinging_pair();
  file["scene"]["pipeline"][4]["energy_tolerance"] = 0;
  file["vary"]["stiffness"]["/pipeline/3/linear"] = {{0, 0, "1 mm/s"},
                                                     {0, 0, 1e200}};  // the second overflows
  const Result result = study(file, {"--json"});
  EXPECT_EQ(result.exit_code, 3) << result.err;
  const json found = json::parse(result.out);
  EXPECT_EQ(found["rows"][0]["status"], "done");
  EXPECT_EQ(found["rows"][1]["status"], "failed");
  EXPECT_TRUE(found["rows"][1]["error"].is_null());
  EXPECT_NE(found["rows"][1]["reason"], "");
  EXPECT_EQ(found["orders"].size(), 1u);
}

TEST_F(StudyCommand, PutsPeersIntoTheTableAndThePlot) {
  std::ofstream(folder_.file("peers.csv"))
      << "label,nodes,error,seconds\nAnother program,100,0.02,0.5\nAnother program,200,0.01,2\n";
  json file = true_swinging_pair();
  const Result result = study(file, {"--peers", folder_.file("peers.csv")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("Another program    2 %      0.5"), std::string::npos) << result.out;
  EXPECT_NE(contents(out() + "/study.svg").find("Another program"), std::string::npos);
  file["peers"] = {"peers.csv"};
  EXPECT_EQ(json::parse(study(file, {"--json"}).out)["peers"].size(), 2u);
}

TEST_F(StudyCommand, ListsAllFaultsOfAStudy) {
  json file = swinging_pair();
  file["repeats"] = 0;
  file["eror"] = "relative_l2";
  file["error"] = "l2";
  file["vary"]["stiffness"]["labels"] = {"stiff"};
  file["compare"]["upper"]["prob"] = "upper";
  file["exclude"] = {{{"step", "0.3 us"}}};
  file["truth"] = {{"value", "much"}};
  expect_refused(file,
                 {"/repeats: 0: expected an integer from 1 to 99",
                  "/eror: \"relative_l2\": expected a known key; did you mean \"error\"?",
                  "/error: \"l2\": expected one of \"relative_l2\"",
                  "/vary/stiffness/labels: 1 values: expected 2",
                  "/compare/upper/prob: \"upper\": expected a known key; did you mean \"probe\"?",
                  "/exclude/0/step: \"0.3 us\": expected a value of \"step\": 0.2 us, 0.1 us, 0.05 "
                  "us; did you mean \"0.2 us\"?",
                  "/truth/value: \"much\": expected a number in SI"});
}

TEST_F(StudyCommand, RefusesWhatDoesNotFitTogether) {
  json file = swinging_pair();
  file["vary"]["step"] = {{"/pipeline/9/time_step", {1e-7, 2e-7}}};
  expect_refused(file, {"/vary/step/~1pipeline~19~1time_step"});
  file = swinging_pair();
  file["compare"]["upper"]["probe"] = "uper";
  expect_refused(file, {"\n/compare/upper/probe: \"uper\": expected a probe of the scene by its "
                        "name: upper; did you mean \"upper\"?"});
  file = swinging_pair();
  file["compare"]["upper"]["column"] = "displacement_y";
  expect_refused(file, {"/compare/upper/column: \"displacement_y\": expected a column of probe "
                        "upper: time, displacement_z"});
  file = swinging_pair();
  file["compare"]["upper"].erase("probe");
  expect_refused(file, {"/compare/upper/column: \"displacement_z\": expected a column of "
                        "history.csv: time, step, kinetic"});
  file = swinging_pair();
  file["truth"].erase(1);
  expect_refused(file, {"expected a truth for every run", "expected a truth for every run",
                        "expected a truth for every run"});
  file = swinging_pair();
  file["truth"] = "finest";
  file["vary"].erase("step");
  file["refine"] = "stiffness";
  expect_refused(file, {"/truth: \"finest\": expected at least 3 values of \"stiffness\""});
  file = swinging_pair();
  file["refine"] = "stif";
  expect_refused(file, {"/refine: \"stif\": expected an axis of \"vary\": step, stiffness"});
  file = swinging_pair();
  file["truth"] = {{"csv", "nowhere.csv"}};
  file["compare"]["upper"]["truth"] = "u";
  expect_refused(file, {"/truth/csv"});
  std::ofstream(folder_.file("truth.csv")) << "t,uz,place\n0,0,1\n";
  file["truth"] = {{"csv", "truth.csv"}, {"where", {{"palce", 1}}}};
  expect_refused(file, {"/compare/upper/truth: \"u\": expected a column of truth.csv: t, uz, "
                        "place; did you mean \"uz\"?",
                        "/truth/where/palce: \"palce\": expected a column of truth.csv: t, uz, "
                        "place; did you mean \"place\"?"});
  expect_refused(swinging_pair(),
                 {"--target-error: much: expected an error above 0 such as 1% or 0.01"},
                 {"--target-error", "much"});
  expect_refused(json::array(), {"study: []: expected an object"});
  EXPECT_EQ(run_program({"study", folder_.file("none.json")}).exit_code, 2);
}

TEST_F(StudyCommand, RefusesATruthAtTimesThatNoRunReaches) {
  json file = swinging_pair();
  file["truth"] = {{"csv", "truth.csv"}};
  file["compare"]["upper"]["truth"] = "u";
  std::ofstream(folder_.file("truth.csv")) << "t,u,u@0,u@1\n5e-6,1,1,1\n";
  const std::string why =
      "expected a truth of \"upper\" at times in s that the run reaches, which ends at 2e-06 s; "
      "\"t\" of truth.csv, times its scale, is from 5e-06 "
      "to "
      "5e-06";
  expect_refused(file, {"/truth/csv: " + why});
  json placed = file;
  // The key `at` takes a column of the probe; "time" is such a column.
  placed["compare"]["upper"]["at"] = "time";
  expect_refused(placed, {"/truth/csv: " + why});
  json longer = file;
  longer["vary"]["end"] = {{"/pipeline/4/end_time", {"2 us", "6 us"}}};
  expect_refused(longer, {" and 5 more): " + why});
  json reduced = file;
  reduced["compare"]["upper"]["reduce"] = "last";  // times do not matter now
  EXPECT_EQ(study(reduced).exit_code, 0);
  EXPECT_EQ(study(file).exit_code, 2) << "also where the runs are there already";
  file["truth"]["over_scale"] = 0.1;
  EXPECT_EQ(study(file).exit_code, 0);
}

TEST_F(StudyCommand, TellsFaultsOfItsScenesOnceEach) {
  json file = swinging_pair();
  file["scene"]["pipeline"][0]["spacin"] = 1;
  file["vary"]["stiffness"]["/pipeline/1/young"] = {"10 GPa", "-5 GPa"};
  expect_refused(file,
                 {"scene /pipeline/0/spacin: 1: expected a known key; did you mean \"spacing\"?",
                  "scene /pipeline/1/young (run step-0.2us_stiffness-soft and 2 more): \"-5 GPa\": "
                  "expected a pressure above 0 Pa"});
}

}  // namespace study_command_test
