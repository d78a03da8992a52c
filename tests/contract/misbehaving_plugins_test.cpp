// Plugins that pass the gate, and then throw, crash, end the program, hang or return unusable data.
// The last line names the plugin, the exit code is 4, and earlier results stay.
#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>
#include <sys/stat.h>
#include <support/program.hpp>

#include <filesystem>

namespace hyperlattice::test {
namespace misbehaving_plugins_test {

const std::string folder = HYPERLATTICE_BUILD "/tests/bad_plugins/misbehaving";

#if defined(HYPERLATTICE_SANITIZED)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

Launch launch_with(const std::string& fault) {
  Launch launch;
  launch.environment = {"HYPERLATTICE_TEST_FAULT=" + fault};
  if (fault == "hang at load")
    launch.environment.push_back("HYPERLATTICE_LOAD_SECONDS=5");  // enough time for sound plugins
  return launch;
}

nlohmann::json scene() {
  nlohmann::json scene = nlohmann::json::parse(R"({
    "format": "hyperlattice/1",
    "pipeline": [
      { "type": "lattices.cubic", "spacing": "1 mm", "shape": { "box": { "low": [0, 0, 0], "high": ["4 mm", "4 mm", "6 mm"] } } },
      { "type": "materials.elastic", "young": "10 GPa", "poisson": 0.25, "density": 2500, "membrane": "none" },
      { "type": "loads.fixed", "on": "z_min" },
      { "type": "solvers.explicit", "end_time": "5 us" } ] })");
  scene["plugins"] = {folder};
  return scene;
}

nlohmann::json scene_with_load() {
  nlohmann::json loaded = scene();
  const nlohmann::json load = {{"type", "loads.misbehaving"}, {"on", "z_max"}};
  loaded["pipeline"].insert(loaded["pipeline"].end() - 1, load);
  return loaded;
}

nlohmann::json scene_with_failure() {
  nlohmann::json pulled = scene();
  pulled["pipeline"][1]["failure"] = {{"type", "failures.misbehaving"}, {"limit", 1e-6}};
  const nlohmann::json load = {
      {"type", "loads.displacement"}, {"on", "z_max"}, {"value", {0, 0, "1 um"}}, {"rise", "1 us"}};
  pulled["pipeline"].insert(pulled["pipeline"].end() - 1, load);
  return pulled;
}

std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n'), begin = text.rfind('\n', end);
  return end == text.npos ? "" : text.substr(begin == text.npos ? 0 : begin + 1, end - begin);
}

struct Fault {
  const char *fault, *says;  ///< part of the last line
  bool signal = false;       ///< the sanitizer reports last
};
void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.fault; }
std::string name_of(const testing::TestParamInfo<Fault>& info) {
  std::string name = info.param.fault;
  for (char& c : name)
    if (c == ' ') c = '_';
  return name;
}

void expect_named(const nlohmann::json& scene, const Fault& fault, const std::string& library) {
  if (sanitized && fault.signal) GTEST_SKIP() << "the sanitizer reports the signal";
  const Folder here("misbehaving");
  const Result result = run_program({"run", write_scene(here, scene), "--out", here.file("out")},
                                    launch_with(fault.fault));
  EXPECT_EQ(result.exit_code, 4) << result.out << result.err;
  const std::string line = last_line(result.err);
  EXPECT_NE(line.find(fault.says), std::string::npos) << result.err;
  EXPECT_NE(line.find(folder + "/" + library + ".so"), std::string::npos) << result.err;
}

class MisbehavingLoad : public testing::TestWithParam<Fault> {};
INSTANTIATE_TEST_SUITE_P(
    All, MisbehavingLoad,
    testing::Values(
        Fault{"exit at load", "ended the program in load(): it called exit"},
        Fault{"hang at load",
              "is still loading: a plugin must load within HYPERLATTICE_LOAD_SECONDS"},
        Fault{"region", "failed in declare(): it asks about region 1234567"},
        Fault{"particle", "failed in declare(): it asks about a particle that does not exist"},
        Fault{"no memory in constructor", "failed in constructor(): not enough memory"},
        Fault{"no memory in declare", "failed in declare(): not enough memory"},
        Fault{"no memory in factor", "failed in factor(): not enough memory"},
        Fault{"no memory in destructor", "ended the program in destructor(): not enough memory"},
        Fault{"wild error", "failed in factor(): U+001B[31mred forged"},
        Fault{"exit in declare", "ended the program in declare(): it called exit"},
        Fault{"null pointer", "ended the program in factor(): segmentation fault", true},
        Fault{"abort", "ended the program in factor(): abort", true},
        Fault{"exit", "ended the program in factor(): it called exit"}),
    name_of);
TEST_P(MisbehavingLoad, IsNamedInTheLastLine) {
  expect_named(scene_with_load(), GetParam(), "loads.misbehaving");
}

class MisbehavingFailure : public testing::TestWithParam<Fault> {};
INSTANTIATE_TEST_SUITE_P(
    All, MisbehavingFailure,
    testing::Values(
        Fault{"throw in alarm", "failed in alarm(): oops"},
        Fault{"nan alarm", "failed in alarm(): it gives an elongation that is no number"},
        Fault{"throw in breaks", "failed in breaks(): oops"},
        Fault{"null pointer in breaks", "ended the program in breaks(): segmentation fault", true},
        Fault{"null pointer in destructor", "ended the program in destructor(): segmentation fault",
              true}),
    name_of);
TEST_P(MisbehavingFailure, IsNamedInTheLastLine) {
  expect_named(scene_with_failure(), GetParam(), "failures.misbehaving");
}

nlohmann::json scene_with_writer() {
  nlohmann::json watched = scene();
  const nlohmann::json load = {
      {"type", "loads.displacement"}, {"on", "z_max"}, {"value", {0, 0, "1 um"}}, {"rise", "1 us"}};
  watched["pipeline"].insert(watched["pipeline"].end() - 1, load);
  watched["pipeline"].push_back({{"type", "writers.misbehaving"}, {"every", "0.5 us"}});
  return watched;
}

/// Returns the frames that a run leaves, in order.
std::vector<std::string> frames_in(const std::string& directory) {
  std::vector<std::string> frames;
  for (int n = 0; n < 100; ++n) {
    const std::string file = fmt::format("{}/sum_{:06}.txt", directory, n);
    if (std::filesystem::exists(file)) frames.push_back(contents(file));
  }
  return frames;
}

class MisbehavingWriter : public testing::TestWithParam<Fault> {};
INSTANTIATE_TEST_SUITE_P(
    All, MisbehavingWriter,
    testing::Values(
        Fault{"throw in frame", "failed in frame(): oops"},
        Fault{"throw in tasks", "failed in frame(): oops in 41"},
        Fault{"no memory in frame", "failed in frame(): not enough memory"},
        Fault{"another field",
              "failed in frame(): it asked for the field \"velocity\", which it did not name"},
        Fault{"null pointer in task", "ended the program in frame(): segmentation fault", true}),
    name_of);
/// The frames are written on other threads than the steps; earlier ones stay.
TEST_P(MisbehavingWriter, IsNamedInTheLastLineAndKeepsEarlierFrames) {
  const Fault fault = GetParam();
  if (sanitized && fault.signal) GTEST_SKIP() << "the sanitizer reports the signal";
  const Folder here("misbehaving");
  const std::string file = write_scene(here, scene_with_writer());
  const Result whole = run_program({"run", file, "--threads", "2", "--out", here.file("whole")});
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  const auto expected = frames_in(here.file("whole"));
  const Result result = run_program({"run", file, "--threads", "2", "--out", here.file("out")},
                                    launch_with(fault.fault));
  EXPECT_EQ(result.exit_code, 4) << result.err;
  const std::string line = last_line(result.err);
  EXPECT_NE(line.find(fault.says), std::string::npos) << result.err;
  EXPECT_NE(line.find(folder + "/writers.misbehaving.so"), std::string::npos) << result.err;
  const auto left = frames_in(here.file("out"));
  ASSERT_GT(left.size(), 1U);
  ASSERT_LT(left.size(), expected.size());
  for (std::size_t n = 0; n < left.size(); ++n) {
    EXPECT_EQ(left[n], expected[n]);
    EXPECT_TRUE(left[n].starts_with("other thread"));
  }
}

TEST(MisbehavingPlugins, ARunThatFailsWritesTheFramesThatWait) {
  const Folder here("misbehaving");
  nlohmann::json scene = scene_with_failure();
  scene["pipeline"][1]["failure"]["limit"] = 1e-4;  // strain; reached while the load rises
  scene["pipeline"][3]["rise"] = "4 us";
  scene["pipeline"].push_back({{"type", "writers.misbehaving"}, {"every", "0.5 us"}});
  const std::string file = write_scene(here, scene);
  const auto frames_of = [&](const char* threads) {
    const std::string out = here.file(threads);
    EXPECT_EQ(run_program({"run", file, "--threads", threads, "--out", out},
                          launch_with("throw in breaks"))
                  .exit_code,
              4);
    return frames_in(out).size();
  };
  const std::size_t without_queue = frames_of("1");
  EXPECT_GE(without_queue, 2U);
  EXPECT_EQ(frames_of("2"), without_queue);
}

/// Unusable data of a load is refused as a fault of the scene, before the run writes any file.
class WrongHandedOver : public testing::TestWithParam<Fault> {};
INSTANTIATE_TEST_SUITE_P(
    All, WrongHandedOver,
    testing::Values(Fault{"axes", "it prescribes an axis that does not exist, or none"},
                    Fault{"amplitude", "it gives an amplitude that is not finite"},
                    Fault{"acceleration", "it gives an acceleration that is not finite"},
                    Fault{"wild refusal", "U+001B[31mred forged"},
                    Fault{"throw an int", "an exception of unknown type"}),
    name_of);
TEST_P(WrongHandedOver, IsRefused) {
  const Folder here("misbehaving");
  const Result result =
      run_program({"run", write_scene(here, scene_with_load()), "--out", here.file("out")},
                  launch_with(GetParam().fault));
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_NE(result.err.find(GetParam().says), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("loads.misbehaving"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(here.file("out")));
}

TEST(MisbehavingPlugins, WhatTheRunHadWrittenStays) {
  nlohmann::json watched = scene_with_failure();
  watched["pipeline"][1]["failure"]["limit"] = 1e-4;  // strain; reached while the load rises
  watched["pipeline"][3]["rise"] = "4 us";
  watched["pipeline"].back()["record_every"] = "0.2 us";
  watched["pipeline"].push_back(
      {{"type", "probes.region"}, {"region", "z_max"}, {"every", "0.2 us"}});
  const Folder here("misbehaving");
  const Result result = run_program({"run", write_scene(here, watched), "--out", here.file("out")},
                                    launch_with("throw in breaks"));
  EXPECT_EQ(result.exit_code, 4) << result.err;
  for (const char* table : {"out/probes/region.csv", "out/history.csv"})
    EXPECT_GT(table_rows(here.file(table)).size(), 2u) << table;
}

TEST(MisbehavingPlugins, AnAlarmBelowAllElongationsAsksAlways) {
  const Folder here("misbehaving");
  const std::string file = write_scene(here, scene_with_failure());
  for (const char* fault : {"none", "alarm below the shortest"}) {
    const Result result = run_program({"run", file, "--out", here.file(fault)}, launch_with(fault));
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  const auto broken = [&](const char* fault) {
    return read_json(here.file(fault) + "/summary.json")["broken_springs"];
  };
  EXPECT_GT(broken("none")["open"], 0);
  EXPECT_EQ(broken("none"), broken("alarm below the shortest"));
}

TEST(MisbehavingPlugins, AStackUsedUpOnAnyThreadIsNamed) {
  if (sanitized) GTEST_SKIP() << "the sanitizer reports the signal";
  const Folder here("misbehaving");
  const std::string file = write_scene(here, scene_with_failure());
  for (const char* threads : {"1", "3"}) {
    const Result result =
        run_program({"run", file, "--threads", threads, "--out", here.file(threads)},
                    launch_with("endless recursion in breaks"));
    EXPECT_EQ(result.exit_code, 4) << result.err;
    EXPECT_NE(last_line(result.err).find("ended the program in breaks(): segmentation fault"),
              std::string::npos)
        << result.err;
  }
}

TEST(MisbehavingPlugins, TheSameErrorWithAnyNumberOfThreads) {
  const Folder here("misbehaving");
  const std::string file = write_scene(here, scene_with_failure());
  const auto said = [&](const char* threads) {
    return last_line(run_program({"run", file, "--threads", threads, "--out", here.file(threads)},
                                 launch_with("throw in breaks"))
                         .err);
  };
  const std::string with_one = said("1");
  EXPECT_NE(with_one.find("failed in breaks(): oops"), std::string::npos) << with_one;
  EXPECT_EQ(said("3"), with_one);
}

TEST(MisbehavingPlugins, ABadExampleIsToldByComponentOptionAndExample) {
  const Result result =
      run_program({"plugins", "--test", "failures.misbehaving", "--plugin-path", folder},
                  launch_with("example"));
  EXPECT_EQ(result.exit_code, 4) << result.out << result.err;
  EXPECT_NE(result.err.find("registers 'failures.misbehaving' with a bad option 'limit': its "
                            "example, 1e-3 mm, is not JSON"),
            std::string::npos)
      << result.err;
}

TEST(MisbehavingPlugins, WhatNobodySeesInADeclarationIsShown) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"plugins", "loads.misbehaving"}, {"plugins"}}) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"--plugin-path", folder});
    const Result result = run_program(all, launch_with("wild help"));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find("MisU+001B[31mbehaves forged"), std::string::npos) << result.out;
    EXPECT_EQ(result.out.find('\x1b'), std::string::npos) << result.out;
    EXPECT_EQ(result.out.find("\nforged"), std::string::npos) << result.out;
  }
}

TEST(MisbehavingPlugins, ALinkToNothingIsNoPlugin) {
  const Folder here("gone");
  std::filesystem::create_symlink("nowhere.so", here.file("loads.gone.so"));
  const Result result = run_program({"plugins", "loads.gone", "--plugin-path", here.path()});
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_NE(result.err.find("loads.gone.so: is a link to nowhere.so, where nothing is"),
            std::string::npos)
      << result.err;
  const Result all = run_program({"plugins", "--why", "--plugin-path", here.path()});
  EXPECT_EQ(all.exit_code, 0) << all.err;
  EXPECT_NE(all.out.find("loads.gone.so: is a link to nowhere.so"), std::string::npos) << all.out;
}

TEST(MisbehavingPlugins, APipeIsNoPlugin) {
  const Folder here("pipe");
  ASSERT_EQ(mkfifo(here.file("loads.pipe.so").c_str(), 0600), 0);
  const Result result = run_program({"plugins", "loads.pipe", "--plugin-path", here.path()});
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_NE(result.err.find("loads.pipe.so: is not a regular file"), std::string::npos)
      << result.err;
}

}  // namespace misbehaving_plugins_test
}  // namespace hyperlattice::test
