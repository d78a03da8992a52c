// Runs that go wrong stop with exit code 3 and say where, when, and the likely cause.
#include "support/program.hpp"

#include <gtest/gtest.h>

namespace guards_test {
using namespace hyperlattice::test;
using nlohmann::json;

/// A block of 6 x 4 x 4 particles of 1 GPa, in which waves take about 1 us from particle to
/// particle.
json block(const json& more, const json& solver) {
  json scene = json::parse(R"({ "format": "hyperlattice/1", "pipeline": [
      { "type": "lattices.cubic", "spacing": "1 mm", "shape": { "box": { "low": [0, 0, 0], "high": ["6 mm", "4 mm", "4 mm"] } } },
      { "type": "materials.elastic", "young": "1 GPa", "poisson": 0.25, "density": 1000 } ] })");
  for (const json& stage : more) scene["pipeline"].push_back(stage);
  json last{{"type", "solvers.explicit"}};
  last.update(solver);
  scene["pipeline"].push_back(last);
  return scene;
}

class Guards : public testing::Test {
 protected:
  /// Runs a scene that must fail. Returns the reason.
  std::string reason(const json& scene, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"run", write_scene(folder, scene), "--out", out, "--overwrite"};
    words.insert(words.end(), more.begin(), more.end());
    const Result result = run_program(words);
    EXPECT_EQ(result.exit_code, 3) << result.err;
    const json summary = read_json(out + "/summary.json");
    EXPECT_EQ(summary.at("status"), "failed");
    EXPECT_TRUE(summary.contains("state_hash"));
    return summary.at("reason");
  }
  Folder folder{"guards"};
  std::string out = folder.file("out");
};

TEST_F(Guards, StopBeforeParticlesPassThroughEachOther) {
  // The left half meets the right half at twice the speed of sound.
  const json start{{"type", "loads.start_velocity"},
                   {"on", {{"box", {{"low", {-1, -1, -1}}, {"high", {"3 mm", 1, 1}}}}}},
                   {"linear", {3000, 0, 0}}};
  const json solver{{"end_time", "20 us"}, {"energy_tolerance", 0}, {"record_every", "0.1 us"}};
  const std::string text = reason(block(json::array({start}), solver));
  EXPECT_NE(text.find("come nearer by"), std::string::npos) << text;
  EXPECT_NE(text.find("approach_limit is 0.5"), std::string::npos) << text;
  EXPECT_NE(text.find("Likely cause: particles pass through each other"), std::string::npos)
      << text;
}

TEST_F(Guards, NameSpringsThatAreStretched) {
  // A block drawn to several times its length by a force that its law cannot resist.
  const json held{{"type", "loads.fixed"}, {"on", "x_min"}};
  const json force{{"type", "loads.force"}, {"on", "x_max"}, {"total", {2e5, 0, 0}}};
  const std::string text =
      reason(block(json::array({held, force}), {{"end_time", "1 ms"}, {"safety", 0.99}}));
  EXPECT_NE(text.find("Likely cause: springs"), std::string::npos) << text;
}

TEST_F(Guards, LeaveAFrameOfTheStateThatFailed) {
  const json held{{"type", "loads.fixed"}, {"on", "x_min"}};
  const json force{{"type", "loads.force"}, {"on", "x_max"}, {"total", {2e5, 0, 0}}};
  json scene = block(json::array({held, force}), {{"end_time", "1 ms"}, {"safety", 0.99}});
  scene["pipeline"].push_back(
      {{"type", "writers.csv"}, {"fields", {"displacement"}}, {"every", 0}});
  reason(scene);
  // The first state and the one that failed.
  const json summary = read_json(out + "/summary.json");
  const std::vector<std::string> rows = table_rows(out + "/frames_times.csv");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_NE(rows.back().find("," + std::to_string(summary.at("steps").get<int>())),
            std::string::npos)
      << rows.back();
}

TEST_F(Guards, NameStretchedSpringsThatShortenTheCriticalStep) {
  // A strain of a half: the stretched springs resist motions across them, too.
  const json held{{"type", "loads.fixed"}, {"on", "x_min"}};
  const json force{
      {"type", "loads.force"}, {"on", "x_max"}, {"total", {8000, 0, 0}}, {"rise", "0.2 ms"}};
  const json stages = json::array({held, force});
  const std::string text = reason(block(stages, {{"end_time", "1 ms"}, {"safety", 0.99}}));
  EXPECT_NE(text.find("have shortened the critical step to about"), std::string::npos) << text;
  // A warning has come before.
  const json warnings = read_json(out + "/summary.json").at("warnings");
  ASSERT_EQ(warnings.size(), 1U) << warnings.dump(1);
  const std::string warning = warnings[0];
  EXPECT_NE(warning.find("s, is longer than springs now allow. Likely cause"), std::string::npos)
      << warning;
  // A run that goes on from a checkpoint after the warning still has it, once.
  EXPECT_EQ(reason(block(stages, {{"end_time", "1 ms"}, {"safety", 0.99}}),
                   {"--checkpoint-every", "1e-9"})
                .find("There is no checkpoint"),
            std::string::npos);
  const Result again = run_program({"run", folder.file("scene.json"), "--out", out, "--resume"});
  EXPECT_EQ(again.exit_code, 3) << again.err;
  EXPECT_EQ(read_json(out + "/summary.json").at("warnings"), warnings);
  // With the step that the message asks for the run ends well.
  const Result result = run_program(
      {"run", write_scene(folder, block(stages, {{"end_time", "1 ms"}, {"safety", 0.75}})), "--out",
       out, "--overwrite"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(Guards, NameTheNewestCheckpoint) {
  const json held{{"type", "loads.fixed"}, {"on", "x_min"}};
  const json force{
      {"type", "loads.force"}, {"on", "x_max"}, {"total", {8000, 0, 0}}, {"rise", "0.2 ms"}};
  const json scene = block(json::array({held, force}), {{"end_time", "1 ms"}, {"safety", 0.99}});
  const std::string none = reason(scene);
  EXPECT_NE(none.find("There is no checkpoint: the run failed within 10 s"), std::string::npos)
      << none;
  EXPECT_NE(reason(scene, {"--checkpoint-every", "0"}).find("--checkpoint-every SECONDS asks"),
            std::string::npos);
  const std::string text = reason(scene, {"--checkpoint-every", "1e-9"});
  const std::size_t at = text.find("The newest checkpoint is of step ");
  ASSERT_NE(at, std::string::npos) << text;
  // Checkpoints are due every 16 steps.
  const int step =
      std::stoi(text.substr(at + std::string("The newest checkpoint is of step ").size()));
  EXPECT_GT(step, 0);
  EXPECT_EQ(step % 16, 0);
  EXPECT_NE(text.find("in " + out + "/checkpoint.bin: --resume goes on from it"), std::string::npos)
      << text;
  // It is there, and the run fails again as before.
  const Result again = run_program({"run", folder.file("scene.json"), "--out", out, "--resume"});
  EXPECT_EQ(again.exit_code, 3) << again.err;
}

TEST_F(Guards, AreSilentWhereNothingIsWrong) {
  const json force{{"type", "loads.force"}, {"on", "x_max"}, {"total", {1, 0, 0}}};
  const Result result =
      run_program({"run", write_scene(folder, block(json::array({force}), {{"end_time", "50 us"}})),
                   "--out", out});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err.find("Likely"), std::string::npos) << result.err;
}

}  // namespace guards_test
