// The surroundings of the process: closed or full streams, places where results cannot go, limits
// on memory, threads and files, and strange values in the environment.
#include "support/program.hpp"

#include <process/processors.hpp>

#include <gtest/gtest.h>

#include <sched.h>

namespace surroundings_test {
using hyperlattice::test::contents;
using hyperlattice::test::Folder;
using hyperlattice::test::Launch;
using hyperlattice::test::read_json;
using hyperlattice::test::Result;
using hyperlattice::test::run_program;
using hyperlattice::test::small_sphere;
using nlohmann::json;

class Surroundings : public testing::Test {
 protected:
  Surroundings() {
    json scene = small_sphere();
    scene["pipeline"][3]["end_time"] = "3 us";
    std::ofstream(folder_.file("scene.json")) << scene.dump();
  }

  /// Runs a shell command in the folder. "$hl" in the command stands for the program.
  Result shell(const std::string& command) const {
    const std::string program = std::string(HYPERLATTICE_BUILD) + "/bin/hyperlattice";
    const std::string line =
        "cd '" + folder_.path() + "' && hl='" + program + "' && { " + command + "; } 2> err";
    const int status = std::system(("bash -c \"" + line + "\"").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status), "",
            contents(folder_.file("err"))};
  }
  Result run(const std::vector<std::string>& more,
             const std::vector<std::string>& environment = {}) const {
    std::vector<std::string> words = {"run", "scene.json", "--out", "out"};
    words.insert(words.end(), more.begin(), more.end());
    Launch launch;
    launch.directory = folder_.path();
    launch.environment = environment;
    return run_program(words, launch);
  }
  json summary() const { return read_json(folder_.file("out/summary.json")); }
  bool exists(const std::string& file) const {
    return std::filesystem::exists(std::filesystem::symlink_status(folder_.file(file)));
  }

  Folder folder_{"surroundings"};
};

TEST_F(Surroundings, AClosedStreamIsNoFileOfTheRun) {
  for (const char* closed : {"2>&-", "1>&-", "0<&-", "0<&- 1>&- 2>&-"}) {
    std::filesystem::remove_all(folder_.file("out"));
    ASSERT_EQ(shell(std::string("\\$hl run scene.json --out out ") + closed).exit_code, 0)
        << closed;
    for (const std::string& row : hyperlattice::test::table_rows(folder_.file("out/history.csv")))
      EXPECT_EQ(std::count(row.begin(), row.end(), ','), 16) << closed << ": " << row;
  }
}

TEST_F(Surroundings, WhatCannotBePrintedIsExit4) {
  ASSERT_EQ(shell("\\$hl run scene.json --out out --quiet").exit_code, 0);
  for (const char* command :
       {"plan scene.json", "plan scene.json --json", "plugins", "schema", "analyze --membrane none",
        "report out", "report out --json", "calibrate --membrane I-m --young 1e9 --poisson 0.2",
        "--version", "--help", "run --help"}) {
    for (const char* nowhere : {" > /dev/full", " >&-"}) {
      const Result result = shell(std::string("\\$hl ") + command + nowhere);
      EXPECT_EQ(result.exit_code, 4) << command << nowhere << ": " << result.err;
      EXPECT_NE(result.err.find("standard output"), std::string::npos)
          << command << nowhere << ": " << result.err;
    }
  }
}

TEST_F(Surroundings, WhatIsNoFolderIsNoPlaceForResults) {
  std::ofstream(folder_.file("file")) << "x";
  std::filesystem::create_symlink("nowhere", folder_.file("dangling"));
  std::filesystem::create_symlink("itself", folder_.file("itself"));
  for (const char* out : {"file", "dangling", "itself", "/dev/null", "/dev/full"}) {
    const Result result = shell(std::string("\\$hl run scene.json --out ") + out);
    EXPECT_EQ(result.exit_code, 2) << out << ": " << result.err;
    EXPECT_NE(result.err.find("expected a folder"), std::string::npos) << result.err;
  }
  EXPECT_EQ(contents(folder_.file("file")), "x");
  EXPECT_FALSE(exists("nowhere"));
}

TEST_F(Surroundings, ThreadsAreThoseThatItMayUse) {
  cpu_set_t before, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
  CPU_ZERO(&one);
  for (int n = 0; n < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++n)
    if (CPU_ISSET(n, &before)) CPU_SET(n, &one);
  const std::vector<std::string> large = {"--set",
                                          "/pipeline/0/shape/hollow_sphere/outer_radius=0.016",
                                          "--overwrite"};  // 16,904 particles
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);    // the program inherits this
  const Result result = run(large);
  sched_setaffinity(0, sizeof before, &before);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(summary()["threads"], 1);
  ASSERT_EQ(run(large).exit_code, 0);
  EXPECT_EQ(summary()["threads"], std::min(hyperlattice::processors(), 4));
  ASSERT_EQ(run({"--overwrite"}).exit_code, 0);
  EXPECT_EQ(summary()["threads"], 1) << "a small body";

  ASSERT_EQ(run({}, {"OMP_NUM_THREADS=3,2"}).exit_code, 0);
  EXPECT_EQ(summary()["threads"], 3);
  ASSERT_EQ(run({"--threads", "2"}, {"OMP_NUM_THREADS=3"}).exit_code, 0);
  EXPECT_EQ(summary()["threads"], 2);
}

TEST_F(Surroundings, AnOddEnvironmentIsRefusedOrChangesNothing) {
  for (const char* bad : {"OMP_NUM_THREADS=many", "OMP_NUM_THREADS=0",
                          "HYPERLATTICE_INSTRUCTIONS=garbage", "HYPERLATTICE_SPRINGS=inexact",
                          "HYPERLATTICE_LOAD_SECONDS=abc", "HYPERLATTICE_LOAD_SECONDS=-1",
                          "HYPERLATTICE_COMPILE_SECONDS=1.5", "HYPERLATTICE_PROGRESS=xml"}) {
    const Result result = run({}, {bad});
    EXPECT_EQ(result.exit_code, 2) << bad;
    EXPECT_NE(result.err.find(std::string(bad).substr(0, std::string(bad).find('='))),
              std::string::npos)
        << result.err;
    EXPECT_FALSE(exists("out"));
  }
  ASSERT_EQ(run({"--threads", "2"}).exit_code, 0);
  const json hash = summary()["state_hash"];
  for (const char* odd : {"OMP_DYNAMIC=true", "OMP_THREAD_LIMIT=1", "OMP_NESTED=true",
                          "OMP_SCHEDULE=dynamic,1", "OMP_PROC_BIND=close", "OMP_STACKSIZE=8G",
                          "LC_ALL=de_DE.UTF-8", "TMPDIR=/nowhere", "HOME="}) {
    ASSERT_EQ(run({"--threads", "2"}, {odd}).exit_code, 0) << odd;
    EXPECT_EQ(summary()["state_hash"], hash) << odd;
    EXPECT_EQ(summary()["threads"], 2) << odd;
  }
}

TEST_F(Surroundings, NumbersOfTheCommandLineAreFinite) {
  for (const char* command : {"run scene.json --out out --checkpoint-every nan",
                              "run scene.json --out out --checkpoint-every inf",
                              "calibrate --membrane I-m --young nan --poisson 0.2",
                              "calibrate --membrane I-m --young 1e9 --poisson nan",
                              "analyze --membrane I-m --lambda inf"})
    EXPECT_EQ(shell(std::string("\\$hl ") + command).exit_code, 2) << command;
  EXPECT_FALSE(exists("out"));
}

TEST_F(Surroundings, AFrameThatIsLargerThanFilesMayBeIsRefusedBeforeTheRun) {
  json scene = small_sphere();
  scene["pipeline"].push_back({{"type", "writers.vtu"}});
  std::ofstream(folder_.file("scene.json")) << scene.dump();
  const Result result = shell("ulimit -f 8; \\$hl run scene.json --out out");
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_NE(result.err.find("ulimit -f"), std::string::npos) << result.err;
  EXPECT_FALSE(exists("out"));
}

#if !defined(HYPERLATTICE_SANITIZED)  // these need all of the address space

TEST_F(Surroundings, ThreadsThatTheSystemRefusesAreExit4WithASummary) {
  if (shell("ulimit -s 1000000").exit_code != 0)
    GTEST_SKIP() << "the limit on stacks cannot be raised here";
  const Result result =
      shell("ulimit -s 1000000; ulimit -v 3000000; \\$hl run scene.json --out out --threads 8");
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_NE(result.err.find("of 8 threads"), std::string::npos) << result.err;
  EXPECT_EQ(summary()["status"], "failed");
  EXPECT_EQ(summary()["exit_code"], 4);

  // A static scene with more sites than a single thread would solve.
  json scene = small_sphere();
  scene["pipeline"][0]["shape"] = {{"box", {{"low", {0, 0, 0}}, {"high", {0.041, 0.041, 0.041}}}}};
  scene["pipeline"][2] = {{"type", "loads.fixed"}, {"on", "z_min"}};
  scene["pipeline"][3] = {{"type", "solvers.static"}};
  std::ofstream(folder_.file("scene.json")) << scene.dump();
  const Result at_rest = shell(
      "export OMP_STACKSIZE=1G; ulimit -v 4000000; \\$hl run scene.json --out out --overwrite "
      "--threads 8");
  EXPECT_EQ(at_rest.exit_code, 4) << at_rest.err;
  EXPECT_NE(at_rest.err.find("of 8 threads"), std::string::npos) << at_rest.err;
  EXPECT_EQ(summary()["exit_code"], 4);

  std::ofstream(folder_.file("scene.json")) << small_sphere().dump();
  ASSERT_EQ(run({"--overwrite"}).exit_code, 0);
  const Result again =
      shell("ulimit -s 1000000; ulimit -v 3000000; \\$hl run scene.json --out out --threads 8");
  EXPECT_EQ(again.exit_code, 4) << again.err;
  EXPECT_NE(again.err.find("nothing was changed"), std::string::npos) << again.err;
  EXPECT_EQ(summary()["status"], "done") << "the earlier run's";
}

/// Raises the memory limit from a value at which no program starts until runs succeed. The picture
/// takes some megabytes that the plan does not count, so that memory also runs out during the run.
TEST_F(Surroundings, LackOfMemoryIsExit4WhereverItIsMet) {
  json scene = small_sphere();
  scene["pipeline"][3]["end_time"] = "1 us";
  scene["pipeline"].push_back({{"type", "writers.picture"}, {"width", 800}, {"height", 600}});
  scene["pipeline"].push_back({{"type", "writers.vtu"}});
  scene["pipeline"].push_back({{"type", "probes.region"}, {"region", "inner_surface"}});
  std::ofstream(folder_.file("scene.json")) << scene.dump();
  constexpr int enough = 3, most_kilobytes = 300'000;
  int done = 0, refused_before = 0, failed_inside = 0;
  for (int kilobytes = 15'000; done < enough && kilobytes < most_kilobytes;
       kilobytes += 211) {  // below, the program is not loaded
    std::filesystem::remove_all(folder_.file("out"));
    const Result result = shell("ulimit -v " + std::to_string(kilobytes) +
                                "; \\$hl run scene.json --out out --threads 2");
    // The system could not load the program, or libgomp ended it before main.
    if (result.exit_code == 127 || result.err.starts_with("\nlibgomp: Out of memory")) continue;
    EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 4)
        << kilobytes << ": " << result.exit_code << ", " << result.err;
    EXPECT_FALSE(result.exit_code == 4 && result.err.empty()) << kilobytes;
    if (result.exit_code == 0)
      ++done;
    else if (!exists("out"))
      ++refused_before;
    else if (result.err.find("not enough memory") != std::string::npos &&
             exists("out/summary.json") && summary()["status"] == "failed")
      ++failed_inside;
  }
  EXPECT_EQ(done, enough);
  EXPECT_GT(refused_before, 0);
  EXPECT_GT(failed_inside, 0);
}

#endif

}  // namespace surroundings_test
