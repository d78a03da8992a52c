// A folder of results belongs to one run. A second run is refused while the first goes on, an
// interrupted run is not lost by mistake, and a new run removes the files of the earlier one and no
// others.
#include <base/own_files.hpp>
#include <support/program.hpp>

#include <gtest/gtest.h>

#include <sys/stat.h>

#include <map>
#include <set>

namespace hyperlattice::test {
namespace folder_test {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t solver = 3;

json scene_with_outputs() {
  json scene = small_sphere();
  scene["pipeline"].push_back({{"type", "writers.vtu"}, {"every", "1 us"}});
  scene["pipeline"].push_back({{"type", "writers.csv"}, {"every", "2 us"}, {"name", "tables"}});
  scene["pipeline"].push_back(
      {{"type", "probes.point"}, {"name", "tip"}, {"position", {0.007, 0, 0}}});
  return scene;
}

json endless() {
  json scene = scene_with_outputs();
  scene["pipeline"][solver]["end_time"] = 10;
  scene["pipeline"][solver]["record_every"] = "1 us";
  scene["pipeline"][4]["every"] = "1 ms";
  scene["pipeline"][5]["every"] = "1 ms";
  return scene;
}

std::map<std::string, std::string> files_in(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder).string()] = contents(entry.path().string());
  return files;
}

class FolderOfARun : public testing::Test {
 protected:
  Result run(const json& scene, std::vector<std::string> more = {}, const Launch& launch = {}) {
    std::vector<std::string> arguments{"run", write_scene(folder, scene), "--out", out, "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments, launch);
  }
  /// Starts a run, waits until its history grows, and calls `then`.
  Result run_meanwhile(const std::function<void(pid_t)>& then, std::vector<std::string> more = {}) {
    return run_meanwhile(endless(), then, std::move(more));
  }
  Result run_meanwhile(const json& scene, const std::function<void(pid_t)>& then,
                       std::vector<std::string> more = {}) {
    Launch launch;
    launch.meanwhile = [&](pid_t child) {
      EXPECT_TRUE(wait_until([&] { return table_rows(out + "/history.csv").size() > 3; }));
      then(child);
    };
    return run(scene, std::move(more), launch);
  }
  void interrupt() {
    ASSERT_EQ(run_meanwhile([](pid_t child) { kill(child, SIGTERM); }).exit_code, 130);
    ASSERT_TRUE(fs::exists(out + "/checkpoint.bin"));
  }

  Folder folder{"folder_of_a_run"};
  std::string out = folder.file("out");
};

TEST_F(FolderOfARun, IsLockedWhileItRuns) {
  Result second;
  const Result first = run_meanwhile([&](pid_t child) {
    for (const char* way : {"--overwrite", "--resume"}) {
      second = run_program({"run", folder.file("scene.json"), "--out", out, "--quiet", way});
      EXPECT_EQ(second.exit_code, std::string(way) == "--resume" ? 2 : 4)
          << second.err;  // no checkpoint exists yet
    }
    second = run_program({"run", folder.file("scene.json"), "--out", out, "--quiet"});
    kill(child, SIGTERM);
  });
  EXPECT_EQ(second.exit_code, 4) << second.err;
  EXPECT_NE(second.err.find("in use"), std::string::npos) << second.err;
  EXPECT_EQ(first.exit_code, 130) << first.err;
  double before = -1;
  for (const std::string& row : table_rows(out + "/history.csv")) {
    EXPECT_GT(std::stod(row), before);
    before = std::stod(row);
  }
}

TEST_F(FolderOfARun, ListsEachOfItsFilesWithItsContent) {
  ASSERT_EQ(run(scene_with_outputs()).exit_code, 0);
  const auto own = read_own_files(out);
  ASSERT_TRUE(own);
  auto files = files_in(out);
  files.erase("files.csv");
  for (const auto& [name, bytes] : files) {
    ASSERT_TRUE(own->count(name)) << name;
    EXPECT_EQ(own->at(name).bytes, bytes.size()) << name;
    EXPECT_EQ(own->at(name).hash.size(), 32u) << name;
  }
  EXPECT_EQ(own->size(), files.size());
}

TEST_F(FolderOfARun, HoldsWhatTheLastRunWroteAndWhatTheUserPutThere) {
  ASSERT_EQ(run(scene_with_outputs()).exit_code, 0);
  for (const char* name : {"notes.txt", "probes/mine.csv", "frames_000099.vtu", "tables/mine.txt"})
    std::ofstream(out + "/" + name) << "mine";
  json shorter = scene_with_outputs();
  shorter["pipeline"][solver]["end_time"] = "3 us";
  shorter["pipeline"].erase(6);
  shorter["pipeline"].erase(5);
  ASSERT_EQ(run(shorter).exit_code, 0);
  std::set<std::string> expected{"files.csv",           "frames.pvd",        "history.csv",
                                 "scene.resolved.json", "summary.json",      "notes.txt",
                                 "probes/mine.csv",     "frames_000099.vtu", "tables/mine.txt"};
  for (int n = 0; n < 4; ++n) expected.insert("frames_00000" + std::to_string(n) + ".vtu");
  std::set<std::string> found;
  for (const auto& [name, bytes] : files_in(out)) found.insert(name);
  EXPECT_EQ(found, expected);
}

TEST_F(FolderOfARun, HoldsACheckpointOfASearchForRestThatWasInterrupted) {
  json scene = json::parse(R"({ "format": "hyperlattice/1", "pipeline": [
    { "type": "lattices.cubic", "spacing": "0.5 mm", "shape": { "box": { "low": [0, 0, 0], "high": ["20 mm", "20 mm", "20 mm"] } } },
    { "type": "materials.elastic", "young": "10 GPa", "poisson": 0.25, "density": 2500 },
    { "type": "loads.fixed", "on": "z_max" }, { "type": "loads.force", "on": "z_min", "total": [0, 0, -100] },
    { "type": "solvers.relaxation", "tolerance": 1e-300 } ] })");
  EXPECT_EQ(run_meanwhile(scene, [](pid_t child) { kill(child, SIGTERM); }).exit_code, 130);
  EXPECT_TRUE(fs::exists(out + "/checkpoint.bin"));
  EXPECT_EQ(read_json(out + "/summary.json")["status"], "interrupted");
}

TEST_F(FolderOfARun, KeepsAnInterruptedRunUnlessToldOtherwise) {
  interrupt();
  const auto before = files_in(out);
  const Result refused = run(small_sphere());
  EXPECT_EQ(refused.exit_code, 2) << refused.err;
  for (const char* word : {"--resume", "--overwrite"})
    EXPECT_NE(refused.err.find(word), std::string::npos) << refused.err;
  EXPECT_TRUE(files_in(out) == before);
  EXPECT_EQ(run(small_sphere(), {"--resume", "--overwrite"}).exit_code, 2);
  const Result replaced = run(small_sphere(), {"--overwrite"});
  EXPECT_EQ(replaced.exit_code, 0) << replaced.err;
  EXPECT_FALSE(fs::exists(out + "/checkpoint.bin"));
  EXPECT_FALSE(fs::exists(out + "/probes"));
}

TEST_F(FolderOfARun, TouchesNoFileThatIsNotARuns) {
  fs::create_directories(out);
  std::ofstream(out + "/history.csv") << "mine";
  const auto before = files_in(out);
  const Result refused = run(small_sphere());
  EXPECT_EQ(refused.exit_code, 2) << refused.err;
  EXPECT_NE(refused.err.find("history.csv"), std::string::npos) << refused.err;
  EXPECT_TRUE(files_in(out) == before);
  EXPECT_EQ(run(small_sphere(), {"--overwrite"}).exit_code, 0);
  std::ofstream(out + "/history.csv", std::ios::app) << "0\n";  // the user has changed the file
  EXPECT_EQ(run(small_sphere()).exit_code, 2);

  fs::remove_all(out);
  fs::create_directories(out);
  std::ofstream(out + "/frames_000001.vtu") << "mine";
  const Result met = run(scene_with_outputs());
  EXPECT_EQ(met.exit_code, 2) << met.err;
  EXPECT_NE(met.err.find("frames_000001.vtu"), std::string::npos) << met.err;
  EXPECT_EQ(contents(out + "/frames_000001.vtu"), "mine");
  EXPECT_FALSE(fs::exists(out + "/history.csv"));
}

TEST_F(FolderOfARun, FollowsNoLinkOutOfIt) {
  const std::string victim = folder.file("victim");
  fs::create_directories(victim);
  fs::create_directories(out);
  fs::create_symlink(victim, out + "/probes");
  EXPECT_EQ(run(scene_with_outputs()).exit_code, 2);
  EXPECT_EQ(run(scene_with_outputs(), {"--overwrite"}).exit_code, 2);
  fs::remove_all(out);
  fs::create_directories(out);
  std::ofstream(victim + "/precious") << "precious";
  std::ofstream(out + "/files.csv")
      << "bytes,hash,name\n,,../victim/precious\n,,link/precious\n,," + victim +
             "/precious\n,,.\n,,x/../../victim/precious\n";
  fs::create_symlink(victim, out + "/link");
  EXPECT_EQ(run(small_sphere()).exit_code, 0);
  EXPECT_EQ(files_in(victim), (std::map<std::string, std::string>{{"precious", "precious"}}));
}

TEST_F(FolderOfARun, MissesATableThatSomebodyElseTouches) {
  const std::string history = out + "/history.csv",
                    removed = " was removed or replaced while the run wrote it";
  const auto replace = [&] {
    fs::copy_file(history, folder.file("copy"));
    fs::rename(folder.file("copy"), history);
  };
  const std::vector<std::tuple<std::string, std::function<void()>, std::string>> touches = {
      {"history.csv", [&] { fs::remove(history); }, removed},
      {"probes/tip.csv", [&] { fs::remove(out + "/probes/tip.csv"); }, removed},
      {"files.csv", [&] { fs::remove(out + "/files.csv"); }, removed},
      {"history.csv", replace, removed},
      {"history.csv", [&] { fs::resize_file(history, 0); },
       " was changed by another program while the run wrote it"}};
  json short_run = endless();
  short_run["pipeline"][solver]["end_time"] = "10 ms";
  for (const bool to_the_end : {false, true})
    for (const auto& [name, touch, message] : touches) {
      fs::remove_all(out);
      const auto then = [&, &do_touch = touch](pid_t child) {
        do_touch();
        if (!to_the_end) kill(child, SIGTERM);
      };
      const Result result = run_meanwhile(to_the_end ? short_run : endless(), then);
      EXPECT_EQ(result.exit_code, 4) << name << result.err;
      EXPECT_NE(result.err.find(out + "/" + name + message), std::string::npos) << result.err;
      EXPECT_EQ(read_json(out + "/summary.json")["status"], "failed");
    }
}

TEST_F(FolderOfARun, KeepsWhatTheSceneReads) {
  std::string table = "x,y,z,volume\n";
  for (int n = 0; n < 125; ++n)
    table += std::to_string(n % 5) + "," + std::to_string(n / 5 % 5) + "," +
             std::to_string(n / 25) + ",1\n";
  const auto expect_kept = [&](const std::string& scene, const std::string& name) {
    const auto before = files_in(out);
    for (const char* way : {"--quiet", "--overwrite"}) {
      const Result result = run_program({"run", scene, "--out", out, way});
      EXPECT_EQ(result.exit_code, 2) << name << result.err;
      EXPECT_NE(result.err.find(out + "/" + name), std::string::npos) << result.err;
      EXPECT_NE(result.err.find("the scene reads it"), std::string::npos) << result.err;
      EXPECT_TRUE(files_in(out) == before) << name;
    }
  };
  for (const std::string name : {"frames_000001.csv", "history.csv", "listed.csv"}) {
    fs::remove_all(out);
    fs::create_directories(out);
    std::ofstream(out + "/" + name) << table;
    if (name == "listed.csv")
      std::ofstream(out + "/files.csv") << "bytes,hash,name\n,,listed.csv\n";
    expect_kept(write_scene(folder, json{{"format", "hyperlattice/1"},
                                         {"pipeline",
                                          {{{"type", "lattices.points"},
                                            {"points", out + "/" + name},
                                            {"scale", "1 mm"},
                                            {"coordination", 14}},
                                           {{"type", "materials.elastic"},
                                            {"young", "10 GPa"},
                                            {"poisson", 0.25},
                                            {"density", 2500}},
                                           {{"type", "loads.fixed"}, {"on", "z_max"}},
                                           {{"type", "solvers.explicit"}, {"end_time", "10 us"}},
                                           {{"type", "writers.csv"}, {"every", "2 us"}}}}}),
                name);
  }
  fs::remove_all(out);
  ASSERT_EQ(run(small_sphere()).exit_code, 0);
  expect_kept(out + "/scene.resolved.json", "scene.resolved.json");
  fs::remove_all(out);
  fs::create_directories(out);
  std::ofstream(out + "/history.csv") << small_sphere().dump();
  expect_kept(out + "/history.csv", "history.csv");
}

TEST_F(FolderOfARun, ReplacesRegularFilesOnly) {
  for (const std::string name :
       {"summary.json", "scene.resolved.json", "history.csv", "files.csv", "checkpoint.bin",
        "frames_000002.vtu", "probes", "probes/tip.csv", "tables", "tables/frames_000001.csv"})
    for (const std::string kind : {"folder", "link", "pipe", "file"}) {
      const bool is_folder = name == "probes" || name == "tables";
      if (kind == (is_folder ? "folder" : "file")) continue;
      fs::remove_all(out);
      const fs::path path = fs::path(out) / name;
      fs::create_directories(path.parent_path());
      if (kind == "folder") fs::create_directory(path);
      if (kind == "link") fs::create_symlink(folder.file("victim"), path);
      if (kind == "pipe") {
        ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
      }
      if (kind == "file") std::ofstream(path) << "mine";
      const auto before = fs::symlink_status(path).type();
      const Result result = run(scene_with_outputs(), {"--overwrite"});
      EXPECT_EQ(result.exit_code, 2) << name << ' ' << kind << result.err;
      EXPECT_NE(result.err.find(path.string()), std::string::npos) << result.err;
      EXPECT_NE(result.err.find("--overwrite"), std::string::npos) << result.err;
      EXPECT_EQ(fs::symlink_status(path).type(), before) << name << ' ' << kind;
      EXPECT_EQ(files_in(out).size(), kind == "file" ? 1u : 0u) << name << ' ' << kind;
      EXPECT_FALSE(fs::exists(folder.file("victim")));
    }
}

TEST_F(FolderOfARun, TakesNoFileOfAUsersCommandWhileItRuns) {
  const Result first = run_meanwhile([&](pid_t child) {
    for (const std::string name : {"later.html", "tables/later.html"}) {
      const Result refused = run_program({"report", out, "--out", out + "/" + name});
      EXPECT_EQ(refused.exit_code, 2) << refused.err;
      EXPECT_NE(refused.err.find("a run is writing in"), std::string::npos) << refused.err;
      EXPECT_FALSE(fs::exists(out + "/" + name));
    }
    EXPECT_EQ(run_program({"analyze", "--membrane", "none", "--dispersion",
                           out + "/tables/frames_009999.csv"})
                  .exit_code,
              2);
    EXPECT_EQ(run_program({"report", out}).exit_code, 0);
    kill(child, SIGTERM);
  });
  EXPECT_EQ(first.exit_code, 130) << first.err;
}

TEST_F(FolderOfARun, NamesOfItsFilesAreRefusedByThePlan) {
  for (const char* name :
       {"summary.json", "scene.resolved.json", "history.csv", "failures.csv", "checkpoint.bin",
        "checkpoint.previous.bin", "files.csv", "probes", "frames.pvd", "frames_000003.vtu"}) {
    json scene = scene_with_outputs();
    scene["pipeline"][5]["name"] = name;
    const Result plan = run_program({"plan", write_scene(folder, scene)});
    EXPECT_EQ(plan.exit_code, 2) << name;
    EXPECT_NE(plan.err.find("/pipeline/5/name"), std::string::npos) << plan.err;
  }
  json scene = scene_with_outputs();
  for (const std::string& file : {std::string(300, 'x'), std::string("../x"), std::string("a/b")}) {
    scene["pipeline"][4]["file"] = file;
    const Result plan = run_program({"plan", write_scene(folder, scene)});
    EXPECT_EQ(plan.exit_code, 2) << file;
    EXPECT_NE(plan.err.find("/pipeline/4/file"), std::string::npos) << plan.err;
  }
}

TEST_F(FolderOfARun, SignalsLeaveACheckpoint) {
  for (const int signal :
       {SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU, SIGPIPE, SIGQUIT, SIGALRM, SIGTERM, SIGINT}) {
    fs::remove_all(out);
    const Result result = run_meanwhile([&](pid_t child) { kill(child, signal); });
    EXPECT_EQ(result.exit_code, 130) << signal << ": " << result.err;
    EXPECT_TRUE(fs::exists(out + "/checkpoint.bin")) << signal;
    EXPECT_TRUE(fs::exists(out + "/summary.json")) << signal;
  }
}

TEST_F(FolderOfARun, AClosedPipeLeavesACheckpoint) {
  const std::string command = "HYPERLATTICE_PROGRESS=json '" + std::string(HYPERLATTICE_BUILD) +
                              "/bin/hyperlattice' run '" + write_scene(folder, endless()) +
                              "' --out '" + out +
                              "' 2>&1 | head -1 > /dev/null; exit ${PIPESTATUS[0]}";
  const char* const words[] = {"bash", "-c", command.c_str(), nullptr};
  const pid_t child = fork();
  if (child == 0) {
    execvp(words[0], const_cast<char* const*>(words));
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_TRUE(fs::exists(out + "/checkpoint.bin"));
}

TEST_F(FolderOfARun, AFailureKeepsTheCheckpoint) {
  json scene = small_sphere();
  scene["pipeline"][solver]["energy_tolerance"] = 1e-14;
  scene["pipeline"][solver]["record_every"] =
      "8 us";  // the loss appears after the first checkpoint
  const Result result = run(scene, {"--checkpoint-every", "1e-9"});
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_NE(result.err.find("--resume"), std::string::npos) << result.err;
  EXPECT_TRUE(fs::exists(out + "/checkpoint.bin"));
}

}  // namespace folder_test
}  // namespace hyperlattice::test
