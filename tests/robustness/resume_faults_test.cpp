// Checkpoints that cannot be used: messages name why, and nothing in the folder changes.
#include "cut_off_runs.hpp"

#include <support/program.hpp>

#include <gtest/gtest.h>

#include <map>

namespace hyperlattice::test {
namespace resume_faults_test {

using nlohmann::json;

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
  json changed = nlohmann::json::parse(whole);
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

}  // namespace resume_faults_test
}  // namespace hyperlattice::test
