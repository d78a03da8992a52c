// The folder of `hyperlattice study`: runs that are reused or repeated, locks, and files that the
// study does not replace.
#include <gtest/gtest.h>
#include <support/study.hpp>

namespace study_folder_test {
using namespace hyperlattice::test;
using nlohmann::json;
namespace fs = std::filesystem;

using StudyFolder = StudyCommand;

TEST_F(StudyFolder, RunsAgainOnlyWhatIsMissing) {
  json file = true_swinging_pair();
  file["repeats"] = 2;
  ASSERT_EQ(study(file).exit_code, 0);
  const auto written = [&](const std::string& run) {
    return fs::last_write_time(out() + "/runs/" + run + "/summary.json");
  };
  const std::string gone = "step-0.1us_stiffness-soft", kept = "step-0.1us_stiffness-stiff";
  const auto before = written(kept), before_repeat = written(gone + "/repeat_2");
  fs::remove(out() + "/runs/" + gone + "/summary.json");
  const Result again = study(file);
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_TRUE(fs::exists(out() + "/runs/" + gone + "/summary.json"));
  EXPECT_EQ(written(kept), before);
  EXPECT_EQ(written(gone + "/repeat_2"), before_repeat);
  const auto count = [](const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
      ++n;
    return n;
  };
  EXPECT_EQ(count(again.err, "there already"), 11u) << again.err;
  EXPECT_EQ(count(again.err, gone + ": there already"), 1u);

  file["scene"]["pipeline"][1]["density"] = 2600;  // no run of this scene exists
  EXPECT_EQ(count(study(file).err, "there already"), 0u);
  EXPECT_EQ(count(study(file, {"--fresh"}).err, "there already"), 0u);
}

TEST_F(StudyFolder, RunsAgainWhatIsNotAsItWasLeft) {
  const json file = true_swinging_pair();
  const std::string first = study(file, {"--json"}).out;
  const std::string runs = out() + "/runs/", cut = "step-0.1us_stiffness-soft",
                    changed = "step-0.2us_stiffness-soft", gone = "step-0.2us_stiffness-stiff",
                    unreadable = "step-0.1us_stiffness-stiff",
                    unlisted = "step-0.05us_stiffness-soft";
  const std::string table = runs + cut + "/probes/upper.csv";
  fs::resize_file(table, fs::file_size(table) / 2);
  std::string text = contents(runs + changed + "/probes/upper.csv");
  text[text.size() - 3] = text[text.size() - 3] == '1' ? '2' : '1';
  std::ofstream(runs + changed + "/probes/upper.csv") << text;
  fs::remove(runs + gone + "/probes/upper.csv");
  std::ofstream(runs + unreadable + "/summary.json") << "{";
  fs::remove(runs + unlisted + "/files.csv");
  const Result again = study(file, {"--json"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  for (const std::string& line : {cut + ": runs again: probes/upper.csv has changed",
                                  changed + ": runs again: probes/upper.csv has changed",
                                  gone + ": runs again: probes/upper.csv is missing",
                                  unreadable + ": runs again: its summary.json cannot be read",
                                  unlisted + ": runs again: its files.csv is missing",
                                  std::string("step-0.05us_stiffness-stiff: there already")})
    EXPECT_NE(again.err.find(line), std::string::npos) << line << '\n' << again.err;
  const json before = json::parse(first), after = json::parse(again.out);
  for (std::size_t r = 0; r < 6; ++r)
    EXPECT_EQ(after["rows"][r]["error"], before["rows"][r]["error"]);
  EXPECT_EQ(study(file).err.find("runs again"), std::string::npos);
}

TEST_F(StudyFolder, LocksItsFolder) {
  json file = true_swinging_pair();
  file["scene"]["pipeline"][4]["end_time"] = "1 s";  // much longer than the test
  std::ofstream(folder_.file("study.json")) << file.dump();
  Launch launch;
  launch.meanwhile = [&](pid_t child) {
    EXPECT_TRUE(wait_until(
        [&] { return fs::exists(out() + "/runs/step-0.2us_stiffness-stiff/history.csv"); }));
    const Result second =
        run_program({"study", folder_.file("study.json"), "--out", out(), "--fresh"});
    EXPECT_EQ(second.exit_code, 4) << second.err;
    EXPECT_NE(second.err.find(out() + " is in use: another study is running there; wait until it "
                                      "ends, or choose another folder"),
              std::string::npos)
        << second.err;
    EXPECT_FALSE(fs::exists(out() + "/study.csv"));
    kill(child, SIGINT);
  };
  EXPECT_EQ(run_program({"study", folder_.file("study.json"), "--out", out()}, launch).exit_code,
            130);
  EXPECT_EQ(study(true_swinging_pair()).exit_code, 0);  // the lock ended with the study
}

TEST_F(StudyFolder, SharesItsFolderWithNoRun) {
  json file = true_swinging_pair();
  const std::string scene = write_scene(folder_, file["scene"]);
  ASSERT_EQ(study(file).exit_code, 0);
  const auto expect_no_run = [&](const std::string& why) {
    for (const char* way : {"--quiet", "--overwrite"}) {
      const Result run = run_program({"run", scene, "--out", out(), way});
      EXPECT_EQ(run.exit_code, 2) << run.err;
      EXPECT_NE(run.err.find(why), std::string::npos) << run.err;
      EXPECT_FALSE(fs::exists(out() + "/files.csv"));
    }
  };
  expect_no_run("the results of a study are there (study.json)");
  EXPECT_NE(study(file).err.find("there already"), std::string::npos);
  fs::remove_all(out());
  json longer = file;
  longer["scene"]["pipeline"][4]["end_time"] = "1 s";  // much longer than the test
  std::ofstream(folder_.file("study.json")) << longer.dump();
  Launch launch;
  launch.meanwhile = [&](pid_t child) {
    EXPECT_TRUE(wait_until(
        [&] { return fs::exists(out() + "/runs/step-0.2us_stiffness-stiff/history.csv"); }));
    expect_no_run("a study is running there");
    kill(child, SIGINT);
  };
  EXPECT_EQ(run_program({"study", folder_.file("study.json"), "--out", out()}, launch).exit_code,
            130);

  fs::remove_all(out());
  ASSERT_EQ(run_program({"run", scene, "--out", out(), "--quiet"}).exit_code, 0);
  const Result refused = study(file);
  EXPECT_EQ(refused.exit_code, 2) << refused.err;
  EXPECT_NE(refused.err.find("the results of a run are there (files.csv)"), std::string::npos)
      << refused.err;
  EXPECT_FALSE(fs::exists(out() + "/runs"));
}

TEST_F(StudyFolder, ReplacesNothingButAStudysResults) {
  std::ofstream(folder_.file("study.json")) << true_swinging_pair().dump();
  const std::string before = contents(folder_.file("study.json"));
  const auto expect_kept = [&](const std::string& name, const std::string& expected) {
    const Result result =
        run_program({"study", folder_.file("study.json"), "--out", folder_.path()});
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_NE(result.err.find(folder_.file(name) + ": expected " + expected), std::string::npos)
        << result.err;
    EXPECT_FALSE(fs::exists(folder_.file("runs")));
  };
  expect_kept("study.json", "a folder in which the study replaces nothing that it needs");
  EXPECT_EQ(contents(folder_.file("study.json")), before);
  fs::create_symlink("victim", folder_.file("study.svg"));
  expect_kept("study.svg", "a regular file, or nothing, of that name");
  EXPECT_FALSE(fs::exists(folder_.file("victim")));
}

TEST_F(StudyFolder, GoesOnAfterAnInterruption) {
  json file = true_swinging_pair();
  file["scene"]["pipeline"][4]["end_time"] = "5 ms";  // at least 25,000 steps
  Launch launch;
  launch.meanwhile = [&](pid_t child) {
    EXPECT_TRUE(wait_until(
        [&] { return fs::exists(out() + "/runs/step-0.2us_stiffness-soft/history.csv"); }));
    kill(child, SIGINT);
  };
  std::ofstream(folder_.file("study.json")) << file.dump();
  const Result cut =
      run_program({"study", folder_.file("study.json"), "--out", out(), "--json"}, launch);
  EXPECT_EQ(cut.exit_code, 130) << cut.err;
  const json found = json::parse(cut.out);
  EXPECT_EQ(found["rows"][0]["status"], "done");
  EXPECT_EQ(found["rows"][5]["status"], "waiting");
  const auto first = fs::last_write_time(out() + "/runs/step-0.2us_stiffness-stiff/summary.json");
  file["exclude"] = {{{"step", {"0.1 us", "0.05 us"}}}};
  EXPECT_EQ(study(file).exit_code, 0);
  EXPECT_EQ(fs::last_write_time(out() + "/runs/step-0.2us_stiffness-stiff/summary.json"), first);
}

}  // namespace study_folder_test
