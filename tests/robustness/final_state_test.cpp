// Runs that start from the final state of another run.
#include <support/state_scenes.hpp>

#include <gtest/gtest.h>

#include <map>

namespace hyperlattice::test {
namespace final_state_test {

using nlohmann::json;

json& solver_of(json& scene) {
  json* found = nullptr;
  for (json& stage : scene["pipeline"])
    if (stage["type"].get<std::string>().starts_with("solvers.")) found = &stage;
  return *found;
}

void without_outputs(json& scene) {
  json kept = json::array();
  for (const json& stage : scene["pipeline"])
    if (!stage["type"].get<std::string>().starts_with("writers.") &&
        !stage["type"].get<std::string>().starts_with("probes."))
      kept.push_back(stage);
  scene["pipeline"] = kept;
}

/// Rows of history.csv after an instant, by the name of the column.
std::vector<std::map<std::string, double>> history_after(const std::string& out, double time) {
  std::vector<std::map<std::string, double>> rows;
  std::istringstream file(contents(out + "/history.csv"));
  std::vector<std::string> names;
  for (std::string line; std::getline(file, line);) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    if (names.empty()) {
      names = cells;
      continue;
    }
    std::map<std::string, double> values;
    for (std::size_t n = 0; n < cells.size(); ++n) values[names[n]] = std::stod(cells[n]);
    if (values["time"] > time) rows.push_back(values);
  }
  return rows;
}

class FinalState : public testing::Test {
 protected:
  Result run(const json& scene, const std::string& out, std::vector<std::string> more = {}) const {
    const std::string file = folder.file("scene_" + std::to_string(scenes_++) + ".json");
    std::ofstream(file) << scene.dump(1);
    std::vector<std::string> arguments{"run", file, "--out", out, "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments);
  }
  void must_run(const json& scene, const std::string& out, std::vector<std::string> more = {}) {
    const Result result = run(scene, out, std::move(more));
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }

  Folder folder{"final_state"};
  std::string first = folder.file("first"), second = folder.file("second");

 private:
  mutable int scenes_ = 0;
};

class Continued : public FinalState, public testing::WithParamInterface<StateCase> {};
INSTANTIATE_TEST_SUITE_P(Scenes, Continued, testing::ValuesIn(state_cases),
                         [](const auto& info) { return std::string(info.param.name); });

/// Two runs, of which the second starts where the first ends, leave the same bits as one run of two
/// stages.
TEST_P(Continued, IsAsOneRunOfTwoStages) {
  json one = pulled_block();
  GetParam().change(one);
  without_outputs(one);
  const bool is_implicit = solver_of(one)["type"] == "solvers.implicit";
  const double half = is_implicit ? 6e-6 : 80e-6;
  solver_of(one)["end_time"] = half;
  json early = one, late = one;
  solver_of(late)["end_time"] = 2 * half;
  json& stages = late["pipeline"];
  for (std::size_t n = 0; n < stages.size(); ++n)  // the preload is done
    if (stages[n]["type"] == "solvers.static") stages.erase(n);
  for (std::size_t n = 0; n < one["pipeline"].size(); ++n)
    if (one["pipeline"][n] == solver_of(one)) {
      json later = one["pipeline"][n];
      later["end_time"] = 2 * half;
      one["pipeline"].insert(one["pipeline"].begin() + static_cast<std::ptrdiff_t>(n) + 1, later);
      break;
    }

  const std::string whole = folder.file("whole");
  ASSERT_NO_FATAL_FAILURE(must_run(one, whole, {"--threads", "2"}));
  ASSERT_NO_FATAL_FAILURE(must_run(early, first, {"--keep-state", "--threads", "2"}));
  ASSERT_NO_FATAL_FAILURE(must_run(late, second, {"--from", first}));

  const json expected = read_json(whole + "/summary.json"),
             found = read_json(second + "/summary.json"),
             before = read_json(first + "/summary.json");
  EXPECT_EQ(found["state_hash"], expected["state_hash"]);
  EXPECT_NE(found["state_hash"], before["state_hash"]);
  EXPECT_EQ(found["end_time"], expected["end_time"]);
  EXPECT_EQ(before["steps"].get<int>() + found["steps"].get<int>(), expected["steps"].get<int>());
  EXPECT_EQ(found["start"]["step"], before["steps"]);
  EXPECT_EQ(found["broken_springs"], expected["broken_springs"]);
  EXPECT_EQ(contents(second + "/failures.csv"), contents(whole + "/failures.csv"));

  const auto rows = history_after(second, half), truth = history_after(whole, half);
  ASSERT_EQ(rows.size(), truth.size());
  ASSERT_GT(rows.size(), 3U);
  for (std::size_t n = 0; n < rows.size(); ++n)
    for (const char* column : {"time", "step", "kinetic", "stored", "dissipated", "momentum_x",
                               "momentum_z", "broken_open", "broken_closed"})
      EXPECT_EQ(rows[n].at(column), truth[n].at(column)) << column << " in row " << n;
}

/// A free cube under a force, and then under another one or a weight.
json pushed_cube(const json& load, const json& end_time) {
  json scene = json::parse(R"({ "format": "hyperlattice/1", "pipeline": [
    { "type": "lattices.cubic", "spacing": 1e-3, "shape": { "box": { "low": [0, 0, 0], "high": [0.006, 0.006, 0.006] } } },
    { "type": "materials.elastic", "young": "10 GPa", "poisson": 0.1, "density": 2500, "membrane": "I-m" },
    {}, { "type": "solvers.explicit" } ] })");
  scene["pipeline"][2] = load;
  scene["pipeline"][3]["end_time"] = end_time;
  return scene;
}

double last_momentum(const std::string& out) { return history_after(out, 0).back()["momentum_x"]; }

/// The momentum is the impulse of both loads, each over its own time and no half step more or less,
/// although the steps of the two runs differ.
TEST_F(FinalState, OtherLoadsActFromTheSameInstantOn) {
  const double push = 20, pull = -50, early = 40e-6, late = 70e-6;  // N, s
  const json pushed = {{"type", "loads.force"}, {"on", "x_max"}, {"total", {push, 0, 0}}},
             pulled = {{"type", "loads.force"}, {"on", "x_min"}, {"total", {pull, 0, 0}}};
  ASSERT_NO_FATAL_FAILURE(must_run(pushed_cube(pushed, early), first, {"--keep-state"}));
  json scene = pushed_cube(pulled, late);
  scene["pipeline"][3]["safety"] = 0.37;
  ASSERT_NO_FATAL_FAILURE(must_run(scene, second, {"--from", first}));
  const double impulse = push * early;
  EXPECT_NEAR(last_momentum(first), impulse, 1e-11 * impulse);
  EXPECT_NEAR(last_momentum(second), impulse + pull * (late - early), 1e-11 * impulse);
  const json energy = read_json(second + "/summary.json")["energy"];
  EXPECT_LT(energy["largest_relative_error"].get<double>(), 1e-6);
  EXPECT_LT(energy["injected"].get<double>(), 0);  // the second load works against the motion

  const json weight = {{"type", "loads.gravity"}, {"acceleration", {-3e4, 0, 0}}};
  ASSERT_NO_FATAL_FAILURE(must_run(pushed_cube(weight, late), second, {"--from", first}));
  const double mass = read_json(second + "/summary.json")["body"]["mass"];
  EXPECT_NEAR(last_momentum(second), impulse - 3e4 * mass * (late - early), 1e-10 * impulse);
}

/// What a load moved goes on with the velocity that it had.
TEST_F(FinalState, WhatWasDrivenIsFree) {
  const json driven = {{"type", "loads.velocity"}, {"on", "all"}, {"value", {2, 0, 0}}},
             weak = {{"type", "loads.force"}, {"on", "x_max"}, {"total", {1e-9, 0, 0}}};
  ASSERT_NO_FATAL_FAILURE(must_run(pushed_cube(driven, "5 us"), first, {"--keep-state"}));
  ASSERT_NO_FATAL_FAILURE(must_run(pushed_cube(weak, "10 us"), second, {"--from", first}));
  const double mass = read_json(second + "/summary.json")["body"]["mass"];
  EXPECT_NEAR(last_momentum(second), 2 * mass, 1e-9 * mass);
}

/// The strength may be another one: the springs that break are those of the new material.
TEST_F(FinalState, OfAnotherStrength) {
  json strong = pulled_block();
  without_outputs(strong);
  solver_of(strong)["end_time"] = "60 us";
  json weak = strong;
  strong["pipeline"][material_stage].erase("failure");
  weak["pipeline"][material_stage]["failure"]["limit"] = "2e-4 mm";
  solver_of(weak)["end_time"] = "61 us";
  ASSERT_NO_FATAL_FAILURE(must_run(strong, first, {"--keep-state"}));
  ASSERT_NO_FATAL_FAILURE(must_run(weak, second, {"--from", first}));
  const json broken = read_json(second + "/summary.json")["broken_springs"];
  EXPECT_GT(broken["open"].get<int>(), 10);
}

/// A run from a state is interrupted and resumed as any other one.
TEST_F(FinalState, IsResumed) {
  json scene = pulled_block();
  scene["pipeline"][material_stage].erase("failure");
  scene["pipeline"][3]["value"] = {0, 0, 0.01};
  without_outputs(scene);
  solver_of(scene)["end_time"] = "50 us";
  ASSERT_NO_FATAL_FAILURE(must_run(scene, first, {"--keep-state"}));
  solver_of(scene)["end_time"] = "2 ms";
  const std::string file = write_scene(folder, scene), whole = folder.file("whole");
  ASSERT_NO_FATAL_FAILURE(must_run(scene, whole, {"--from", first}));
  Launch launch;
  launch.meanwhile = [&](pid_t child) {
    wait_until([&] {
      return std::filesystem::exists(second + "/history.csv") &&
             table_rows(second + "/history.csv").size() > 20;
    });
    kill(child, SIGINT);
  };
  const std::vector<std::string> words{"run", file, "--out", second, "--quiet"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), words.begin(), words.end());
    return more;
  };
  ASSERT_EQ(run_program(with({"--from", first}), launch).exit_code, 130);
  const Result forgotten = run_program(with({"--resume"}));
  EXPECT_EQ(forgotten.exit_code, 2);
  EXPECT_NE(forgotten.err.find("state.bin (--from) is gone"), std::string::npos) << forgotten.err;
  const Result resumed = run_program(with({"--resume", "--from", first}));
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(contents(second + "/history.csv"), contents(whole + "/history.csv"));
  EXPECT_EQ(read_json(second + "/summary.json")["state_hash"],
            read_json(whole + "/summary.json")["state_hash"]);
}

class FinalStateFaults : public FinalState {
 protected:
  void SetUp() override {
    scene = pulled_block();
    scene["pipeline"][material_stage].erase("failure");
    without_outputs(scene);
    solver_of(scene)["end_time"] = "10 us";
    ASSERT_NO_FATAL_FAILURE(must_run(scene, first, {"--keep-state"}));
    solver_of(scene)["end_time"] = "20 us";
  }
  /// Expects that a run is refused with these words, and that it writes nothing.
  void refuses(const std::vector<std::string>& words) {
    const Result result = run(scene, second, {"--from", first});
    EXPECT_EQ(result.exit_code, 2) << result.err;
    for (const std::string& word : words)
      EXPECT_NE(result.err.find(word), std::string::npos) << word << " is not in " << result.err;
    EXPECT_FALSE(std::filesystem::exists(second));
  }

  json scene;
};

TEST_F(FinalStateFaults, AnotherBody) {
  scene["pipeline"][lattice_stage]["spacing"] = 0.5e-3;
  scene["pipeline"][material_stage] = {{"type", "materials.plastic"},
                                       {"young", "10 GPa"},
                                       {"density", 2500},
                                       {"membrane", "none"},
                                       {"yield", "5 MPa"}};
  scene["precision"] = "float";
  refuses({"particles: 2880 in the state", "places of particles",
           "materials: materials.elastic in the state, materials.plastic in the scene",
           "degrees of freedom: 4 in the state, 3 in the scene",
           "precision: double in the state, float in the scene", "numbers that laws keep"});
}

TEST_F(FinalStateFaults, AnEndThatIsOver) {
  solver_of(scene)["end_time"] = "10 us";
  refuses({"/pipeline/5", "end_time after 1e-05 s, where the stage starts"});
}

TEST_F(FinalStateFaults, DamagedOrMissing) {
  const std::string file = first + "/state.bin", whole = contents(file);
  std::string damaged = whole;
  damaged[whole.size() / 2] = static_cast<char>(damaged[whole.size() / 2] ^ 1);
  for (const std::string& bytes : {damaged, whole.substr(0, whole.size() / 2), std::string("?")}) {
    std::ofstream(file, std::ios::binary) << bytes;
    refuses({"--from", "a state that is whole"});
  }
  std::filesystem::remove(file);
  refuses({"--from", "--keep-state", "there is none"});
}

/// A run writes no state unless it is asked to, and a done run says how to go on from its end.
TEST_F(FinalStateFaults, ResumedRunThatIsDone) {
  solver_of(scene)["end_time"] = "10 us";
  ASSERT_NO_FATAL_FAILURE(must_run(scene, second));
  EXPECT_FALSE(std::filesystem::exists(second + "/state.bin"));
  const Result no_state = run(scene, second, {"--resume"});
  EXPECT_EQ(no_state.exit_code, 2);
  EXPECT_NE(no_state.err.find("run it with --keep-state"), std::string::npos) << no_state.err;
  const Result has_state = run(scene, first, {"--resume"});
  EXPECT_EQ(has_state.exit_code, 2);
  EXPECT_NE(has_state.err.find("by --from " + first), std::string::npos) << has_state.err;
}

/// The run that left the state is not replaced by the run that starts from it.
TEST_F(FinalStateFaults, IntoTheSameFolder) {
  const std::string before = contents(first + "/summary.json");
  const Result result = run(scene, first, {"--from", first});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("the scene reads it"), std::string::npos) << result.err;
  EXPECT_EQ(contents(first + "/summary.json"), before);
}

}  // namespace final_state_test
}  // namespace hyperlattice::test
