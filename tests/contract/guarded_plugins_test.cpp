// Runs with laws and loads of plugins that break their contract: the guards of a run stop it, in
// the same step on any number of threads and after --resume.
#include <gtest/gtest.h>
#include <support/program.hpp>

namespace hyperlattice::test {
namespace guarded_plugins_test {

using nlohmann::json;

/// A free block of 4 x 4 x 6 particles.
json scene(const json& material, const json& load, const json& solver) {
  json scene = json::parse(R"({ "format": "hyperlattice/1", "pipeline": [
      { "type": "lattices.cubic", "spacing": "1 mm", "shape": { "box": { "low": [0, 0, 0], "high": ["4 mm", "4 mm", "6 mm"] } } } ] })");
  scene["plugins"] = {HYPERLATTICE_BUILD "/tests/wrong_plugins"};
  json made{{"young", "10 GPa"}, {"poisson", 0.25}, {"density", 2500}};
  made.update(material);
  json explicit_steps{{"type", "solvers.explicit"}};
  explicit_steps.update(solver);
  for (const json& stage : {made, load, explicit_steps}) scene["pipeline"].push_back(stage);
  return scene;
}

/// Springs 1.5 times as stiff as their constants say: steps of 0.9 critical ones are 1.1 of the
/// critical step of the infinite lattice. The block turns, so that its waves begin small.
json unstable(const json& solver = json::object()) {
  json steps{{"end_time", "50 us"}, {"record_every", "1 us"}};
  steps.update(solver);
  return scene({{"type", "materials.stiffer"}},
               {{"type", "loads.start_velocity"}, {"angular", {1, 2, 3}}}, steps);
}

json forgetful(const json& solver = json::object()) {
  json steps{{"end_time", "100 us"}, {"energy_tolerance", 0}};
  steps.update(solver);
  return scene({{"type", "materials.elastic"}}, {{"type", "loads.forgetful"}, {"on", "z_max"}},
               steps);
}

class GuardedPlugins : public testing::Test {
 protected:
  /// Runs the scene and returns its summary.
  json run(const json& scene, int exit_code, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"run", write_scene(folder, scene), "--out", out};
    words.insert(words.end(), more.begin(), more.end());
    const Result result = run_program(words);
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    return read_json(out + "/summary.json");
  }
  /// Runs a scene that must fail. Returns the reason without the sentence about checkpoints.
  std::string reason(const json& scene, const std::vector<std::string>& more = {}) {
    const json summary = run(scene, 3, more);
    EXPECT_EQ(summary.at("status"), "failed");
    const std::string text = summary.at("reason");
    return text.substr(
        0, std::min(text.find(" There is no checkpoint"), text.find(" The newest checkpoint")));
  }
  static bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }
  Folder folder{"guarded_plugins"};
  std::string out = folder.file("out");
};

TEST_F(GuardedPlugins, StopMotionsThatGrowFromNothing) {
  const std::string text = reason(unstable());
  EXPECT_PRED2(says, text, "energy grows from nothing");
  EXPECT_PRED2(says, text, "growth_limit is 2");
  EXPECT_PRED2(says, text, "law materials.stiffer (/pipeline/1)");
  EXPECT_PRED2(says, text, " of the critical ");
  EXPECT_PRED2(says, text,
               "springs that stiffen or are stretched have shortened the critical step");
  // The balance closes: no other guard sees this motion for as long as it is small.
  const json summary = read_json(out + "/summary.json");
  EXPECT_LT(summary.at("energy").at("largest_relative_error").get<double>(), 1e-6);
}

TEST_F(GuardedPlugins, AreSilentInStepsThatTheLawAllows) {
  const json summary = run(unstable({{"safety", 0.6}}), 0);
  EXPECT_TRUE(summary.at("warnings").empty()) << summary.dump(1);
}

TEST_F(GuardedPlugins, StopGrowthInTheSameStepEverywhere) {
  const std::string text = reason(unstable(), {"--threads", "1"});
  EXPECT_EQ(reason(unstable(), {"--threads", "2", "--overwrite"}), text);
  // With checkpoints every 16 steps, the run goes on from the newest one and fails as before.
  EXPECT_EQ(reason(unstable(), {"--threads", "1", "--overwrite", "--checkpoint-every", "1e-9"}),
            text);
  const json first = read_json(out + "/summary.json");
  ASSERT_PRED2(says, first.at("reason").get<std::string>(), "The newest checkpoint is of step");
  EXPECT_EQ(reason(unstable(), {"--threads", "1", "--resume"}), text);
  const json again = read_json(out + "/summary.json");
  EXPECT_EQ(again.at("warnings"), first.at("warnings"));
  EXPECT_EQ(again.at("state_hash"), first.at("state_hash"));
}

TEST_F(GuardedPlugins, KeepNoCheckpointOfAStateThatHasGoneWrong) {
  const auto step_of = [](const std::string& text, const std::string& before) {
    return std::stoi(text.substr(text.find(before) + before.size()));
  };
  json off{{"energy_tolerance", 0}, {"growth_limit", 0}, {"record_every", "1 ns"}};
  const int wrong = step_of(reason(unstable(off)), "step ");
  // Without records until the end, only checkpoints and the checks of every 50 steps look.
  off["record_every"] = "1 s";
  off.erase("energy_tolerance");
  const std::string late =
      run(unstable(off), 3, {"--overwrite", "--checkpoint-every", "1e-9"})["reason"];
  EXPECT_GT(step_of(late, "step "), wrong + 16) << late;
  const int kept = step_of(late, "The newest checkpoint is of step ");
  EXPECT_LT(kept, wrong) << late;
  EXPECT_GE(kept, wrong - 16) << late;
}

TEST_F(GuardedPlugins, StopLoadsThatDoNotExplainTheMomentum) {
  const std::string text = reason(forgetful());
  EXPECT_PRED2(says, text, "momentum is lost");
  EXPECT_PRED2(says, text, "momentum_tolerance is 0.001");
  EXPECT_PRED2(says, text, "law materials.elastic (/pipeline/1)");
  run(forgetful({{"momentum_tolerance", 0}}), 0, {"--overwrite"});
}

}  // namespace guarded_plugins_test
}  // namespace hyperlattice::test
