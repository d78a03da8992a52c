// Runs seen from outside: the files after a normal end, an interruption, a failure, or a full disk.
#include "support/program.hpp"

#include <gtest/gtest.h>

#include <set>

namespace run_test {
using namespace hyperlattice::test;
using nlohmann::json;

constexpr std::size_t material = 1, load = 2, solver = 3;

json breakable_sphere() {
  json scene = small_sphere();
  scene["pipeline"][material]["failure"] = {{"type", "failures.elongation"},
                                            {"limit", "3.5e-3 mm"}};
  scene["pipeline"][load]["peak"] = "200 MPa";
  return scene;
}

/// A scene whose run does not end by itself.
json endless_sphere() {
  json scene = small_sphere();
  scene["pipeline"][solver]["end_time"] = 10;
  scene["pipeline"][solver]["record_every"] = "1 us";
  return scene;
}

class Run : public testing::Test {
 protected:
  Result run(const json& scene, std::vector<std::string> more = {}, const Launch& launch = {}) {
    std::vector<std::string> arguments{"run", write_scene(folder, scene), "--out", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments, launch);
  }
  json summary() const { return read_json(out + "/summary.json"); }
  std::vector<std::string> history() const { return table_rows(out + "/history.csv"); }

  Folder folder{"run"};
  std::string out = folder.file("out");
};

TEST_F(Run, leaves_what_is_promised) {
  json scene = breakable_sphere();
  scene["pipeline"].push_back({{"type", "writers.vtu"},
                               {"fields", {"displacement", "broken_open", "damage"}},
                               {"every", "5 us"}});
  scene["pipeline"].push_back(
      {{"type", "probes.point"}, {"name", "tip"}, {"position", {0.007, 0, 0}}});
  const Result result = run(scene, {"--threads", "2"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json s = summary();
  for (const char* key :
       {"status", "version", "particles", "springs", "degrees_of_freedom", "steps", "time_step",
        "critical_time_step", "end_time", "threads", "precision", "wall_seconds",
        "nanoseconds_per_particle_step", "bytes_per_particle", "peak_memory_bytes", "energy",
        "broken_springs", "state_hash", "plugins"})
    EXPECT_TRUE(s.contains(key)) << key;
  for (const char* key : {"setup", "solve", "output"})
    EXPECT_GT(s["wall_seconds"][key].get<double>(), 0) << key;
  for (const char* key : {"kinetic", "stored", "dissipated", "injected", "relative_error"})
    EXPECT_TRUE(s["energy"][key].is_number()) << key;
  EXPECT_EQ(s["status"], "done");
  EXPECT_EQ(s["degrees_of_freedom"], 4);
  EXPECT_EQ(s["threads"], 2);
  EXPECT_EQ(s["precision"], "double");
  EXPECT_EQ(s["end_time"], 10e-6);
  EXPECT_LT(std::abs(s["energy"]["relative_error"].get<double>()), 1e-3);
  EXPECT_GT(s["energy"]["injected"].get<double>(), 0);
  EXPECT_GT(s["energy"]["dissipated"].get<double>(), 0);

  const std::uint64_t broken = s["broken_springs"]["open"].get<std::uint64_t>() +
                               s["broken_springs"]["closed"].get<std::uint64_t>();
  EXPECT_GT(broken, 0u);
  EXPECT_EQ(table_rows(out + "/failures.csv").size(), broken);
  EXPECT_EQ(history().size(),
            s["steps"].get<std::size_t>() / 10 + 2);  // first step, every tenth, last step
  EXPECT_EQ(table_rows(out + "/probes/tip.csv").size(),
            std::min<std::size_t>(201, s["steps"].get<std::size_t>() + 1));
  std::size_t frames = 0;
  for (const auto& entry : std::filesystem::directory_iterator(out))
    frames += entry.path().extension() == ".vtu" ? 1 : 0;
  EXPECT_EQ(frames, 3u);

  std::set<std::string> plugins;
  for (const json& plugin : s["plugins"]) plugins.insert(plugin["name"].get<std::string>());
  EXPECT_EQ(plugins, (std::set<std::string>{"lattices.cubic", "materials.elastic",
                                            "failures.elongation", "loads.blast",
                                            "solvers.explicit", "writers.vtu", "probes.point"}));
}

TEST_F(Run, resolved_scene_gives_the_same_bits_on_any_number_of_threads) {
  ASSERT_EQ(run(breakable_sphere(), {"--threads", "1"}).exit_code, 0);
  const json first = summary();
  const std::string resolved = folder.file("resolved.json"), again = folder.file("again");
  std::filesystem::copy_file(out + "/scene.resolved.json", resolved);
  for (const char* threads : {"2", "3"}) {
    const Result result = run_program({"run", resolved, "--out", again, "--threads", threads});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json second = read_json(again + "/summary.json");
    EXPECT_EQ(first["state_hash"], second["state_hash"]) << threads;
    EXPECT_EQ(first["energy"], second["energy"]) << threads;
    EXPECT_EQ(contents(out + "/history.csv"), contents(again + "/history.csv")) << threads;
    EXPECT_EQ(contents(out + "/failures.csv"), contents(again + "/failures.csv")) << threads;
    EXPECT_EQ(contents(out + "/scene.resolved.json"), contents(again + "/scene.resolved.json"));
  }
}

TEST_F(Run, plan_tells_what_the_summary_confirms_and_writes_nothing) {
  const std::string scene = write_scene(folder, small_sphere());
  const Result plan = run_program({"plan", scene, "--json", "--threads", "2"});
  ASSERT_EQ(plan.exit_code, 0) << plan.err;
  const json planned = json::parse(plan.out);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"scene.json"});
  ASSERT_EQ(run(small_sphere(), {"--threads", "2"}).exit_code, 0);
  const json done = summary();
  for (const char* key :
       {"version", "particles", "springs", "degrees_of_freedom", "steps", "time_step",
        "critical_time_step", "end_time", "threads", "precision", "bytes_per_particle", "plugins"})
    EXPECT_EQ(planned.at(key), done.at(key)) << key;
  EXPECT_FALSE(done.contains("left_out"));
  std::set<std::string> left_out;
  for (const json& entry : planned.at("left_out")) {
    left_out.insert(entry.at("what").get<std::string>());
    EXPECT_FALSE(entry.at("why").get<std::string>().empty());
  }
  for (const char* what :
       {"failure", "mixed materials", "local damping", "body acceleration", "writers"})
    EXPECT_TRUE(left_out.count(what)) << what;
  EXPECT_FALSE(left_out.count("fourth dimension"));

  const Result text = run_program({"plan", scene});
  for (const char* part :
       {"lattices.cubic", "bytes per particle", "critical time step", "Left out"})
    EXPECT_NE(text.out.find(part), std::string::npos) << part << "\n" << text.out;
}

TEST_F(Run, interrupted_ends_in_order) {
  for (const int signal : {SIGINT, SIGTERM}) {
    std::filesystem::remove_all(out);
    json scene = endless_sphere();
    scene["pipeline"].push_back({{"type", "writers.csv"}, {"every", 0}});
    Launch launch;
    launch.meanwhile = [&](pid_t child) {
      EXPECT_TRUE(wait_until([&] { return history().size() > 5; }));
      kill(child, signal);
    };
    const Result result = run(scene, {}, launch);
    EXPECT_EQ(result.exit_code, 130) << result.err;
    const json s = summary();
    EXPECT_EQ(s["status"], "interrupted");
    EXPECT_LT(s["steps"].get<std::uint64_t>(), s["planned_steps"].get<std::uint64_t>());
    EXPECT_EQ(contents(out + "/history.csv").back(), '\n');
    const std::string last = history().back();
    // The last row holds the state at the end.
    EXPECT_EQ(std::stod(last), s["end_time"].get<double>());
    EXPECT_TRUE(std::filesystem::exists(out + "/frames_000001.csv"));
  }
}

TEST_F(Run, a_body_without_rest_leaves_how_it_moves) {
  json scene = small_sphere();
  scene["pipeline"][load] = {
      {"type", "loads.force"}, {"on", "outer_surface"}, {"total", {0, 0, 1}}};
  scene["pipeline"][solver] = {{"type", "solvers.static"}};
  const Result result = run(scene);
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_NE(result.err.find("failing_motion.csv"), std::string::npos) << result.err;
  const std::vector<std::string> rows = table_rows(out + "/failing_motion.csv");
  EXPECT_EQ(rows.size(), summary()["particles"]);
  for (const std::string& row : rows) {  // the body slides along z
    double x, y, z, along[3];
    ASSERT_EQ(std::sscanf(row.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf", &x, &y, &z, &along[0], &along[1],
                          &along[2]),
              6)
        << row;
    EXPECT_NEAR(along[0], 0, 1e-9);
    EXPECT_NEAR(along[1], 0, 1e-9);
    EXPECT_NEAR(along[2], 1, 1e-9);
  }
}

TEST_F(Run, full_disk_keeps_whole_lines) {
  Launch launch;
  launch.file_limit = 8000;
  const Result result = run(endless_sphere(), {}, launch);
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_NE(result.err.find("history.csv"), std::string::npos) << result.err;
  const std::string text = contents(out + "/history.csv");
  EXPECT_EQ(text.back(), '\n');
  EXPECT_GT(text.size(), 6000u);
  const auto rows = history();
  for (const std::string& row : rows) EXPECT_EQ(std::count(row.begin(), row.end(), ','), 16) << row;
  EXPECT_EQ(summary()["status"], "failed");
}

TEST_F(Run, an_output_folder_that_cannot_be_is_an_outside_fault) {
  std::ofstream(folder.file("file")) << "x";
  const Result result = run_program(
      {"run", write_scene(folder, small_sphere()), "--out", folder.file("file") + "/out"});
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_NE(result.err.find("file/out"), std::string::npos) << result.err;
}

TEST_F(Run, too_little_memory_says_how_much_is_needed) {
#if defined(HYPERLATTICE_SANITIZED)
  GTEST_SKIP() << "the address sanitizer needs all of the address space";
#endif
  json scene = small_sphere();
  scene["pipeline"][0]["shape"]["hollow_sphere"] = {{"inner_radius", "20 mm"},
                                                    {"outer_radius", "50 mm"}};
  Launch launch;
  launch.memory_limit = 50'000'000;  // the memory holds the lattice but not the state
  const Result result = run(scene, {"--threads", "1"}, launch);
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_NE(result.err.find("too little memory: the run needs "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("ulimit -v"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(Run, two_writers_of_a_kind_keep_apart) {
  json scene = small_sphere();
  scene["pipeline"].push_back({{"type", "writers.csv"}, {"every", 0}});
  scene["pipeline"].push_back(
      {{"type", "writers.csv"}, {"every", 0}, {"first", false}, {"name", "late"}});
  ASSERT_EQ(run(scene).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(out + "/frames_000001.csv"));
  EXPECT_TRUE(std::filesystem::exists(out + "/late/frames_000000.csv"));
  EXPECT_FALSE(std::filesystem::exists(out + "/late/frames_000001.csv"));
  EXPECT_EQ(contents(out + "/frames_000001.csv"), contents(out + "/late/frames_000000.csv"));
}

TEST_F(Run, lost_balance_stops_and_says_where) {
  json scene = small_sphere();
  scene["pipeline"][solver]["energy_tolerance"] = 1e-14;
  const Result result = run(scene);
  EXPECT_EQ(result.exit_code, 3);
  const json s = summary();
  EXPECT_EQ(s["status"], "failed");
  const std::string reason = s["reason"];
  for (const char* part :
       {"step ", "t = ", "energy", "particle", "materials.elastic", "/pipeline/1", "critical"})
    EXPECT_NE(reason.find(part), std::string::npos) << reason;
  EXPECT_GE(history().size(), 2u);
  EXPECT_TRUE(std::filesystem::exists(out + "/scene.resolved.json"));
}

TEST_F(Run, runaway_stops_between_records) {
  json scene = small_sphere();
  scene["pipeline"][load]["peak"] = 1e16;
  scene["pipeline"][solver]["energy_tolerance"] = 0;
  scene["pipeline"][solver]["end_time"] = 1;
  scene["pipeline"][solver]["record_every"] = 1;
  const Result result = run(scene);
  EXPECT_EQ(result.exit_code, 3) << result.err;
  const json s = summary();
  EXPECT_LE(s["steps"].get<std::uint64_t>(), 100u);
  EXPECT_NE(s["reason"].get<std::string>().find("particle"), std::string::npos) << s["reason"];
}

TEST_F(Run, unsafe_step_is_refused_before_anything_is_written) {
  json scene = small_sphere();
  scene["pipeline"][solver]["time_step"] = "1 us";
  const Result result = run(scene);
  EXPECT_EQ(result.exit_code, 2);
  for (const char* part : {"/pipeline/3/time_step", "at most", "stable limit"})
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
  EXPECT_EQ(folder.names(), std::vector<std::string>{"scene.json"});
}

TEST_F(Run, a_field_that_the_run_has_not_is_refused) {
  json scene = small_sphere();
  scene["pipeline"].push_back({{"type", "writers.vtu"}, {"fields", {"displacement", "damage"}}});
  const Result result = run(scene);
  EXPECT_EQ(result.exit_code, 2);
  for (const char* part : {"/pipeline/4", "damage", "height"})
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(Run, stages_follow_one_another) {
  json scene = small_sphere();
  json second = scene["pipeline"][solver];
  second["end_time"] = "20 us";
  second["damping"] = 0.8;
  scene["pipeline"].push_back(second);
  ASSERT_EQ(run(scene).exit_code, 0);
  const json s = summary();
  EXPECT_EQ(s["end_time"], 20e-6);
  ASSERT_EQ(s["stages"].size(), 2u);
  EXPECT_EQ(s["stages"][1]["start_time"], s["stages"][0]["end_time"]);
  EXPECT_GT(s["energy"]["dissipated_damping"].get<double>(), 0);
  EXPECT_LT(std::abs(s["energy"]["relative_error"].get<double>()), 1e-2);
  double before = -1;
  for (const std::string& row : history()) {
    EXPECT_GT(std::stod(row), before);
    before = std::stod(row);
  }

  std::swap(scene["pipeline"][solver], scene["pipeline"][solver + 1]);
  const Result wrong = run(scene);
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("/pipeline/4/end_time"), std::string::npos) << wrong.err;
}

TEST_F(Run, progress_for_programs_is_json) {
  Launch launch;
  launch.environment = {"HYPERLATTICE_PROGRESS=json"};
  const Result result = run(small_sphere(), {}, launch);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::istringstream lines(result.err);
  json last;
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && line.front() == '{') last = json::parse(line);
  ASSERT_TRUE(last.is_object()) << result.err;
  EXPECT_EQ(last["step"], last["steps"]);
  for (const char* key : {"time", "time_step", "eta_seconds"})
    EXPECT_TRUE(last.contains(key)) << key;
}

}  // namespace run_test
