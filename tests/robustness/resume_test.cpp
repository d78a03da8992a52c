// Runs that are cut off repeatedly, at any step, and resumed. They leave the same files, byte for
// byte, as a run that was never cut off.
#include <base/own_files.hpp>
#include <support/state_scenes.hpp>

#include <gtest/gtest.h>

#include <map>

namespace hyperlattice::test {
namespace resume_test {

using nlohmann::json;

/// All files of a run, without its times.
std::map<std::string, std::string> left_behind(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[std::filesystem::relative(entry.path(), folder).string()] =
          contents(entry.path().string());
  json summary = json::parse(files.at("summary.json"));
  for (const char* key : {"wall_seconds", "nanoseconds_per_particle_step", "peak_memory_bytes"})
    summary.erase(key);
  files["summary.json"] = summary.dump(1);
  std::string& list = files["files.csv"];  // only the last entry of each file counts
  const OwnFiles own = parse_own_files(list);
  list.clear();
  for (const auto& [name, file] : own)
    if (name != "summary.json") list += own_file_line(name, file);
  return files;
}

class Resume : public testing::TestWithParam<StateCase> {
 protected:
  Resume() { GetParam().change(scene); }
  Result run(const std::string& out, std::vector<std::string> more = {},
             const Launch& launch = {}) {
    std::vector<std::string> arguments{"run", file, "--out", out, "--threads", "2", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments, launch);
  }
  /// Runs to the end. The signal cuts the run off repeatedly, after about 40 more rows of the
  /// history.
  void cut_off_and_go_on(int signal, const std::string& out, const std::vector<std::string>& more) {
    constexpr std::size_t rows = 40;  // rows of the history between two cuts
    std::size_t cuts = 0, next = rows;
    std::vector<std::string> arguments = more;
    for (;;) {
      Launch launch;
      launch.meanwhile = [&](pid_t child) {
        const auto far_enough = [&] {
          siginfo_t ended{};
          waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT);
          if (ended.si_pid != 0) return true;
          return std::filesystem::exists(out + "/history.csv") &&
                 table_rows(out + "/history.csv").size() > next &&
                 (signal != SIGKILL || std::filesystem::exists(out + "/checkpoint.bin"));
        };
        wait_until(far_enough);
        kill(child, signal);
      };
      const Result result = run(out, arguments, launch);
      if (result.exit_code == 0) break;
      ASSERT_TRUE(result.exit_code == 130 || result.exit_code == 1000 + SIGKILL)
          << result.exit_code << result.err;
      ++cuts;
      next += rows;
      ASSERT_LT(cuts, 100u);
      arguments = more;
      arguments.push_back("--resume");
    }
    std::printf("cut off %zu times\n", cuts);
    EXPECT_GT(cuts, 0u);
  }
  void compare(const std::string& out) {
    const auto found = left_behind(out), expected = left_behind(whole);
    for (const auto& [name, bytes] : expected) {
      ASSERT_TRUE(found.count(name)) << name;
      EXPECT_TRUE(found.at(name) == bytes) << name;
    }
    for (const auto& [name, bytes] : found) EXPECT_TRUE(expected.count(name)) << name;
  }

  Folder folder{"resume"};
  json scene = pulled_block();
  std::string file, whole = folder.file("whole");
};
INSTANTIATE_TEST_SUITE_P(Scenes, Resume, testing::ValuesIn(state_cases),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_P(Resume, LeavesNoTrace) {
  file = write_scene(folder, scene);
  const Result never_cut_off = run(whole);
  ASSERT_EQ(never_cut_off.exit_code, 0) << never_cut_off.err;
  for (const auto& [signal, every] : {std::pair{SIGINT, "0"}, std::pair{SIGKILL, "0.001"}}) {
    const std::string out = folder.file(signal == SIGINT ? "interrupted" : "killed");
    ASSERT_NO_FATAL_FAILURE(cut_off_and_go_on(signal, out, {"--checkpoint-every", every}));
    compare(out);
  }
}

/// Times add up over all parts of a run, as the steps do.
TEST(ResumedTimes, AreOfAllSteps) {
  const Folder folder("resume_times");
  json scene = pulled_block();
  json& pipeline = scene["pipeline"];
  pipeline[material_stage].erase("failure");
  pipeline[3]["value"] = {0, 0, 0.01};
#ifdef HYPERLATTICE_SANITIZED
  pipeline[5]["end_time"] = "2 ms";  // as long as 10 ms without sanitizers
#else
  pipeline[5]["end_time"] = "10 ms";
#endif
  while (pipeline.size() > 6) pipeline.erase(6);
  const std::string file = write_scene(folder, scene), out = folder.file("out");
  constexpr std::size_t most_of_200 = 130;  // rows of the history
  Launch launch;
  launch.meanwhile = [&](pid_t child) {
    EXPECT_TRUE(wait_until([&] {
      return std::filesystem::exists(out + "/history.csv") &&
             table_rows(out + "/history.csv").size() > most_of_200;
    }));
    kill(child, SIGINT);
  };
  const Result cut_off =
      run_program({"run", file, "--out", out, "--threads", "1", "--quiet"}, launch);
  ASSERT_EQ(cut_off.exit_code, 130) << cut_off.err;
  const double first = read_json(out + "/summary.json")["wall_seconds"]["solve"];
  const Result resumed = run_program({"run", file, "--out", out, "--resume", "--quiet"});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  const json summary = read_json(out + "/summary.json");
  const double both = summary["wall_seconds"]["solve"],
               work = summary["particles"].get<double>() * summary["steps"].get<double>();
  EXPECT_GT(both, 0.9 * first);
  EXPECT_NEAR(summary["nanoseconds_per_particle_step"].get<double>(), 1e9 * both / work,
              1e-9 * 1e9 * both / work);
}

/// Makes sure that a killed run has a checkpoint.bin. A kill between the two renames of a
/// checkpoint (core/run/checkpoint.cpp) leaves only the previous checkpoint, which is then copied.
void restore_checkpoint(const std::string& out) {
  const std::string newest = out + "/checkpoint.bin", earlier = out + "/checkpoint.previous.bin";
  if (!std::filesystem::exists(newest) && std::filesystem::exists(earlier))
    std::filesystem::copy_file(earlier, newest);
}

class ResumeFaults : public testing::Test {
 protected:
  void SetUp() override {
    json scene = pulled_block();
    scene["pipeline"][5]["end_time"] = 1;
    file = write_scene(folder, scene);
    Launch launch;
    launch.meanwhile = [&](pid_t child) {
      EXPECT_TRUE(wait_until([&] { return std::filesystem::exists(out + "/checkpoint.bin"); }));
      kill(child, SIGKILL);
    };
    run_program({"run", file, "--out", out, "--threads", "2", "--checkpoint-every", "0.001"},
                launch);
    restore_checkpoint(out);
  }
  Result resume(std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"run", file, "--out", out, "--resume"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments);
  }

  Folder folder{"resume"};
  std::string file, out = folder.file("out");
};

TEST_F(ResumeFaults, NothingToResume) {
  out = folder.file("elsewhere");
  const Result result = resume();
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_NE(result.err.find("--resume"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("there is none"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(ResumeFaults, AnotherScene) {
  const auto before = contents(out + "/checkpoint.bin");
  const Result result = resume({"--set", "/pipeline/1/young=2e10"});
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_NE(result.err.find("a checkpoint of this scene"), std::string::npos) << result.err;
  EXPECT_EQ(contents(out + "/checkpoint.bin"), before);
}

TEST_F(ResumeFaults, IncludedFilesArePartOfTheScene) {
  const std::string parts = folder.file("parts.json"), whole = contents(file);
  nlohmann::json changed = nlohmann::json::parse(whole);
  changed["pipeline"][1]["young"] = 2e10;
  std::ofstream(file) << R"({"include": "parts.json"})";
  std::ofstream(parts) << changed.dump();
  EXPECT_EQ(resume().exit_code, 2);
  std::ofstream(parts) << whole;
  Launch launch;
  launch.meanwhile = [](pid_t child) {
    std::this_thread::sleep_for(std::chrono::seconds(2));
    kill(child, SIGINT);
  };
  const Result result = run_program({"run", file, "--out", out, "--resume"}, launch);
  EXPECT_EQ(result.exit_code, 130) << result.err;
}

/// All files of a folder with their bytes.
std::map<std::string, std::string> all_of(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[entry.path().string()] = contents(entry.path().string());
  return files;
}

TEST_F(ResumeFaults, DamagedOrCutOff) {
  std::filesystem::remove(out + "/checkpoint.previous.bin");
  const std::string path = out + "/checkpoint.bin", whole = contents(path);
  std::string damaged = whole;
  damaged[whole.size() / 2] = static_cast<char>(damaged[whole.size() / 2] ^ 1);
  for (const std::string& bytes :
       {damaged, whole.substr(0, whole.size() / 2), std::string("no checkpoint at all"),
        whole + "x", std::string()}) {
    std::ofstream(path, std::ios::binary) << bytes;
    const auto before = all_of(out);
    const Result result = resume();
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_NE(result.err.find("a checkpoint that is whole"), std::string::npos) << result.err;
    EXPECT_TRUE(all_of(out) == before) << "a refusal touches nothing";
  }
}

/// If a file or table from before the checkpoint has changed, the message names it, and all files
/// stay as they are.
TEST_F(ResumeFaults, ChangedResults) {
  const auto refuses = [&](const std::string& name,
                           const std::function<void(const std::string& path)>& change) {
    const std::string bytes = contents(out + "/" + name);
    change(out + "/" + name);
    const auto before = all_of(out);
    const Result result = resume();
    EXPECT_EQ(result.exit_code, 2) << name << ": " << result.err;
    EXPECT_NE(result.err.find(name), std::string::npos) << result.err;
    EXPECT_TRUE(all_of(out) == before) << name;
    std::ofstream(out + "/" + name, std::ios::binary) << bytes;
  };
  const auto shorten = [](const std::string& path) { std::ofstream(path) << "time\n"; };
  const auto remove = [](const std::string& path) { std::filesystem::remove(path); };
  const auto edit = [](const std::string& path) {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(3);
    file.put('#');
  };
  for (const std::string name : {"history.csv", "probes/top.csv", "frames_000000.vtu",
                                 "tables/frames_000000.csv", "scene.resolved.json"}) {
    refuses(name, shorten);
    refuses(name, remove);
    refuses(name, edit);
  }
  refuses("frames.pvd", remove);
  refuses("files.csv", shorten);
}

/// A run as in ResumeFaults with an early end.
class Earlier : public ResumeFaults {};

TEST_F(Earlier, CheckpointIsUsedWithAWord) {
  json scene = pulled_block();
  scene["pipeline"][5]["end_time"] = "300 us";
  file = write_scene(folder, scene);
  const std::string whole = folder.file("whole");
  out = folder.file("killed");
  ASSERT_EQ(run_program({"run", file, "--out", whole, "--threads", "2"}).exit_code, 0);
  Launch launch;
  launch.meanwhile = [&](pid_t child) {
    wait_until([&] {
      return std::filesystem::exists(out + "/checkpoint.previous.bin") ||
             contents(out + "/summary.json").find("done") != std::string::npos;
    });
    kill(child, SIGKILL);
  };
  run_program({"run", file, "--out", out, "--threads", "2", "--checkpoint-every", "0.001"}, launch);
  if (!std::filesystem::exists(out + "/checkpoint.previous.bin"))
    GTEST_SKIP() << "the run was done before it was killed";
  restore_checkpoint(out);
  std::ofstream(out + "/checkpoint.bin", std::ios::binary | std::ios::in).put('?');
  const Result result = resume();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("goes on from the checkpoint before it"), std::string::npos)
      << result.err;
  EXPECT_TRUE(left_behind(out) == left_behind(whole));
}

}  // namespace resume_test
}  // namespace hyperlattice::test
