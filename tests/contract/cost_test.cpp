// A scene costs only what it names: each feature adds its own share of mapped libraries, memory and
// files. The test counts allocations in the allocator, and reads the libraries from the process.
#include <support/program.hpp>

#include <plan/plan.hpp>
#include <state/layout.hpp>
#include <state/simulation.hpp>

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <set>

namespace {
// Bytes in aligned arrays: the state of a simulation and its temporary arrays.
std::atomic<std::size_t> allocated{0};
}  // namespace

void* operator new[](std::size_t size, std::align_val_t alignment) {
  allocated += size;
  const std::size_t step = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(step, (size + step - 1) / step * step)) return memory;
  throw std::bad_alloc();
}
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }

namespace {
using namespace hyperlattice;
using nlohmann::json;

json minimal_scene() {
  return json::parse(R"({ "format": "hyperlattice/1", "pipeline": [
    { "type": "lattices.cubic", "spacing": 1e-3, "shape": { "box": { "low": [0, 0, 0], "high": [0.011, 0.010, 0.009] } } },
    { "type": "materials.elastic", "young": 1e10, "density": 2500, "membrane": "none" },
    { "type": "solvers.explicit", "end_time": 1e-5 } ] })");
}
void make_listed(json& scene) { scene["pipeline"][0]["type"] = "lattices.random"; }

/// A feature that a scene may add, and its cost in a grid and in a list.
struct Feature {
  const char* name;
  const char* left_out;  ///< the entry in the plan's list of unused features
  const char* library;   ///< library of the feature; empty: none
  void (*add)(json& scene);
  double bytes_per_place = 0, bytes_per_listed_spring = 0;  ///< per end of a spring
};
const Feature features[] = {
    {"failure", "failure", "failures.elongation",
     [](json& scene) {
       scene["pipeline"][1]["failure"] = {{"type", "failures.elongation"}, {"limit", 1e-3}};
     },
     0, 8},
    {"membrane", "fourth dimension", "",
     [](json& scene) {
       scene["pipeline"][1].update({{"membrane", "I"}, {"lambda", 0.5}});
     },
     16},
    {"second_material", "mixed materials", "",
     [](json& scene) {
       json second = scene["pipeline"][1];
       second.update(
           {{"young", 2e10}, {"region", {{"box", {{"low", {0, 0, 0}}, {"high", {1, 1, 0.004}}}}}}});
       scene["pipeline"].push_back(second);
     },
     1, 16},
    {"damping", "local damping", "", [](json& scene) { scene["pipeline"][2]["damping"] = 0.5; }},
    {"gravity", "body acceleration", "loads.gravity",
     [](json& scene) {
       scene["pipeline"].push_back({{"type", "loads.gravity"}, {"acceleration", {0, 0, -9.81}}});
     }},
    {"probe", "probes", "probes.point",
     [](json& scene) {
       scene["pipeline"].push_back(
           {{"type", "probes.point"}, {"name", "middle"}, {"position", {5e-3, 5e-3, 5e-3}}});
     }},
    {"writer", "writers", "writers.csv",
     [](json& scene) {
       scene["pipeline"].push_back({{"type", "writers.csv"}});
     }},
};
void PrintTo(const Feature& feature, std::ostream* out) { *out << feature.name; }
std::string name_of(const testing::TestParamInfo<Feature>& info) { return info.param.name; }

std::unique_ptr<Plan> plan_of(const json& scene, int threads = 1) {
  const test::Folder folder("cost");
  static Host host;
  return make_plan(read_scene(test::write_scene(folder, scene), {}, host), threads);
}

std::set<std::string> left_out(const json& scene) {
  std::set<std::string> names;
  const auto plan = plan_of(scene);
  for (const LeftOut& left : plan->left_out) names.insert(left.what);
  return names;
}

double bytes(const Plan& plan) {
  return plan.bytes_per_particle * static_cast<double>(plan.model->body.particles);
}

struct Size {
  double places = 0;  ///< particles, with the padding
  /// Ends of a list's springs, with the padding: eight particles (sixteen in floats) each take as
  /// much as the one with the most springs.
  double ends = 0;
};
Size size_of(const Model& model) {
  Size size;
  const auto layout = make_layout(model, 1);
  size.places = static_cast<double>(layout->blocks[0].sites);
  std::vector<double> springs(model.body.particles);
  model.body.for_springs(
      [&](Particle a, Particle b, std::uint32_t) { ++springs[a], ++springs[b]; });
  const std::size_t pack = 64 / bytes_of(model.springs.choice.precision);
  for (std::size_t n = 0; n < springs.size(); n += pack)
    size.ends +=
        static_cast<double>(pack) *
        *std::max_element(
            springs.begin() + static_cast<std::ptrdiff_t>(n),
            springs.begin() + static_cast<std::ptrdiff_t>(std::min(n + pack, springs.size())));
  return size;
}

TEST(Cost, PlainBodiesHoldTheirMotionTheirSpringsAndNothingElse) {
  const auto grid = plan_of(minimal_scene());
  constexpr double motion = 2 * 3 * 8, alive = 2;
  EXPECT_EQ(grid->model->body.particles, 990u);
  EXPECT_EQ(bytes(*grid), (motion + alive) * size_of(*grid->model).places);

  json scene = minimal_scene();
  make_listed(scene);
  const auto list = plan_of(scene);
  const Size size = size_of(*list->model);
  constexpr double record = 8 * 8, neighbour = 4, read_ahead = 32 * 8;
  EXPECT_EQ(bytes(*list), (motion + alive + record) * size.places +
                              neighbour * (size.ends + read_ahead) + 4 * (size.places / 8 + 1));
}

// The memory of a law has its own numbers and two more, in doubles, for each base and cross spring;
// in a list, for each end.
TEST(Cost, AMemoryIsItsNumbers) {
  for (const char* lattice : {"lattices.cubic", "lattices.random"})
    for (const char* precision : {"double", "float"})
      for (const bool membrane : {false, true}) {
        json scene = minimal_scene();
        scene["precision"] = precision;
        scene["pipeline"][0]["type"] = lattice;
        if (membrane) scene["pipeline"][1].update({{"membrane", "I"}, {"lambda", 0.5}});
        const auto without = plan_of(scene, 3);
        scene["pipeline"][1].update(
            {{"type", "materials.relaxing"}, {"time", 1e-6}, {"share", 0.5}});
        const auto with = plan_of(scene, 3), with_one_thread = plan_of(scene);
        const std::size_t before = allocated;
        const Simulation simulation(*with->model, 3);
        EXPECT_EQ(static_cast<double>(allocated - before),
                  bytes(*with) + simulation.scratch_bytes())
            << lattice << precision;
        scene["pipeline"][1]["type"] = "materials.elastic";
        scene["pipeline"][1].erase("time");
        scene["pipeline"][1].erase("share");
        const Size size = size_of(*with->model);
        const double springs =
            scene["pipeline"][0]["type"] == "lattices.cubic" ? 9 * size.places : size.ends;
        EXPECT_EQ(bytes(*with_one_thread),
                  bytes(*plan_of(scene)) + (membrane ? 2 : 1) * (1 + 2) * 8 * springs)
            << lattice << precision;
        EXPECT_GT(bytes(*with), bytes(*without));
      }
}

TEST(Cost, ThePlanCountsSprings) {
  const auto plan = plan_of(minimal_scene());
  const auto pairs = [](int dx, int dy, int dz) { return (11 - dx) * (10 - dy) * (9 - dz); };
  const int springs = pairs(1, 0, 0) + pairs(0, 1, 0) + pairs(0, 0, 1) +
                      2 * (pairs(1, 1, 0) + pairs(1, 0, 1) + pairs(0, 1, 1));
  EXPECT_EQ(plan_json(*plan)["springs"], springs);
  EXPECT_EQ(plan_json(*plan)["springs_per_particle"], springs / 990.0);
}

TEST(Cost, AHundredMillionParticlesArePlannedToTheByteWithoutTheirMemory) {
#if defined(HYPERLATTICE_SANITIZED)
  GTEST_SKIP() << "the sanitizer needs terabytes of address space";
#endif
  json scene = minimal_scene();
  scene["pipeline"][0]["shape"]["box"]["high"] = {0.5, 0.5, 0.4};
  const test::Folder folder("cost");
  test::Launch launch;
  launch.memory_limit = 400'000'000;  // address space, bytes: four per particle
  const test::Result planned = test::run_program(
      {"plan", test::write_scene(folder, scene), "--threads", "1", "--json"}, launch);
  ASSERT_EQ(planned.exit_code, 0) << planned.err;
  const json plan = json::parse(planned.out);
  EXPECT_EQ(plan["particles"], 100'000'000);
  // Rows are whole vectors. The margin at each end holds a row and the reach of a neighbour.
  constexpr double row = 504, rows = 500 * 400, margin = 536;
  EXPECT_EQ(plan["bytes_per_particle"], 50 * (rows * row + 2 * margin) / 100e6);
  // Bytes of the program, of the look for cells inside out, and of a row with its sums.
  constexpr double program = 14e6, look = 24.0 * (1 << 19), of_row = 280;
  EXPECT_LT(plan["memory_bytes"], 50 * (rows * row + 2 * margin) + program + look + rows * of_row);
}

class FeatureCost : public testing::TestWithParam<Feature> {};
INSTANTIATE_TEST_SUITE_P(Features, FeatureCost, testing::ValuesIn(features), name_of);

TEST_P(FeatureCost, IsItsOwnBytes) {
  for (const bool listed : {false, true}) {
    json scene = minimal_scene();
    if (listed) make_listed(scene);
    const auto without = plan_of(scene);
    GetParam().add(scene);
    const auto with = plan_of(scene);
    const Size size = size_of(*with->model);
    const double added = GetParam().bytes_per_place * size.places +
                         (listed ? GetParam().bytes_per_listed_spring * size.ends : 0);
    EXPECT_EQ(bytes(*with), bytes(*without) + added) << (listed ? "list" : "grid");
  }
}

TEST_P(FeatureCost, IsAllocatedAsPlanned) {
  for (const bool listed : {false, true})
    for (const int threads : {1, 3}) {
      json scene = minimal_scene();
      if (listed) make_listed(scene);
      GetParam().add(scene);
      const auto plan = plan_of(scene, threads);
      const std::size_t before = allocated;
      const Simulation simulation(*plan->model, threads);
      EXPECT_EQ(static_cast<double>(allocated - before), bytes(*plan) + simulation.scratch_bytes())
          << (listed ? "list, " : "grid, ") << threads;
    }
}

TEST_P(FeatureCost, IsLeftOutOfAScenesPlanThatDoesNotNameIt) {
  json scene = minimal_scene();
  EXPECT_TRUE(left_out(scene).contains(GetParam().left_out));
  GetParam().add(scene);
  EXPECT_FALSE(left_out(scene).contains(GetParam().left_out));
}

/// The files of this build that the running program has mapped (`mapped`), the plugins that the
/// summary names (`named`), both without folders, and the files that the run leaves (`left`).
struct Traces {
  std::set<std::string> mapped, named, left;
};
Traces traces_of(json scene) {
  // The run is longer than the test, which interrupts it.
  scene["pipeline"][2].update({{"end_time", 10}, {"record_every", 1e-6}});
  const test::Folder folder("cost");
  const std::string file = test::write_scene(folder, scene), out = folder.file("out");
  Traces traces;
  test::Launch launch;
  launch.meanwhile = [&](pid_t program) {
    EXPECT_TRUE(
        test::wait_until([&] { return test::table_rows(out + "/history.csv").size() > 1; }));
    std::ifstream maps("/proc/" + std::to_string(program) + "/maps");
    for (std::string line; std::getline(maps, line);)
      if (const auto path = line.find(HYPERLATTICE_BUILD); path != std::string::npos)
        traces.mapped.insert(std::filesystem::path(line.substr(path)).stem().string());
    kill(program, SIGINT);
  };
  EXPECT_EQ(test::run_program({"run", file, "--out", out, "--quiet"}, launch).exit_code, 130);
  const json summary = test::read_json(out + "/summary.json");
  for (const json& plugin : summary["plugins"])
    traces.named.insert(std::filesystem::path(plugin["path"].get<std::string>()).stem().string());
  for (const auto& entry : std::filesystem::recursive_directory_iterator(out))
    traces.left.insert(entry.path().filename().string());
  return traces;
}
const std::set<std::string> minimal_libraries{"lattices.cubic", "materials.elastic",
                                              "solvers.explicit"};

TEST(Cost, AMinimalSceneMapsAndWritesOnlyWhatItNames) {
  const Traces traces = traces_of(minimal_scene());
  std::set<std::string> expected = minimal_libraries;
  EXPECT_EQ(traces.named, expected);
  expected.insert({"hyperlattice", "libhyperlattice.so.0.1"});
  EXPECT_EQ(traces.mapped, expected);
  // An interrupted run leaves a checkpoint.
  EXPECT_EQ(traces.left, (std::set<std::string>{"summary.json", "scene.resolved.json",
                                                "history.csv", "files.csv", "checkpoint.bin"}));
}

TEST_P(FeatureCost, IsItsOwnLibrary) {
  json scene = minimal_scene();
  GetParam().add(scene);
  const Traces traces = traces_of(scene);
  std::set<std::string> expected = minimal_libraries;
  if (*GetParam().library != '\0') expected.insert(GetParam().library);
  EXPECT_EQ(traces.named, expected);
  expected.insert({"hyperlattice", "libhyperlattice.so.0.1"});
  EXPECT_EQ(traces.mapped, expected);
}

}  // namespace
