// Runs that are cut off repeatedly, at any step, and resumed. They leave the same files, byte for
// byte, as a run that was never cut off.
#include "cut_off_runs.hpp"

#include <gtest/gtest.h>

namespace hyperlattice::test {
namespace resume_test {

using nlohmann::json;

/// A block whose top is moved, or turned aside, until it is at rest.
void make_rest(json& scene, const json& moved, const json& solver) {
  json& pipeline = scene["pipeline"];
  pipeline.erase(4);
  pipeline[lattice_stage]["shape"]["box"]["high"] = {0.006, 0.006, 0.01};
  for (json& stage : pipeline)
    if (stage["type"] == "probes.point") stage["position"] = {0.003, 0.003, 0.01};
  pipeline[3] = {
      {"type", "loads.displacement"}, {"on", "z_max"}, {"value", moved}, {"rise", "1 ms"}};
  pipeline[4] = solver;
}

const StateCase rest_cases[] = {
    {"rest_breaking",
     [](json& scene) {
       make_rest(scene, {0, 0, 3.2e-5}, {{"type", "solvers.static"}, {"load_steps", 100}});
     }},
    {"rest_falling",  // the load falls where springs break
     [](json& scene) {
       make_rest(scene, {0, 0, 3.2e-5},
                 {{"type", "solvers.static"}, {"load_steps", 100}, {"snap_back", true}});
     },
     20},
    {"rest_bending",  // so far that the preconditioner is made anew
     [](json& scene) {
       make_rest(scene, {4e-3, 0, 0}, {{"type", "solvers.static"}, {"load_steps", 60}});
       scene["pipeline"][material_stage].erase("failure");
     },
     20},
    {"rest_cracking",  // controlled by an opening
     [](json& scene) {
       make_rest(scene, {0, 0, 2e-5},
                 {{"type", "solvers.static"},
                  {"opening_from", "z_min"},
                  {"opening_to", "z_max"},
                  {"opening_step", 1e-7},
                  {"opening_end", 1e-5}});
       scene["pipeline"][material_stage].update({{"membrane", "none"},
                                                 {"poisson", 0.25},
                                                 {"failure",
                                                  {{"type", "failures.cohesive"},
                                                   {"strength", "2.5 MPa"},
                                                   {"fracture_energy", "15 J/m2"}}}});
     }},
    {"rest_damped",
     [](json& scene) {
       make_rest(scene, {0, 0, 1e-5},
                 {{"type", "solvers.relaxation"},
                  {"method", "accelerated"},
                  {"tolerance", 1e-9},
                  {"displacement_error", 1e-9}});
       scene["pipeline"][lattice_stage]["shape"]["box"]["high"] = {0.012, 0.012, 0.03};
       scene["pipeline"][material_stage].erase("failure");
     }},
};

class Resume : public testing::TestWithParam<StateCase> {
 protected:
  Resume() { GetParam().change(scene); }
  Result run(const std::string& out, std::vector<std::string> more = {},
             const Launch& launch = {}) {
    std::vector<std::string> arguments{"run", file, "--out", out, "--threads", "2", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments, launch);
  }
  /// Runs to the end. The signal cuts the run off repeatedly, after some more rows of the history.
  void cut_off_and_go_on(int signal, const std::string& out, const std::vector<std::string>& more) {
    const std::size_t rows = GetParam().rows;
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
      next = table_rows(out + "/history.csv").size() + rows;
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
INSTANTIATE_TEST_SUITE_P(Rest, Resume, testing::ValuesIn(rest_cases),
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

}  // namespace resume_test
}  // namespace hyperlattice::test
