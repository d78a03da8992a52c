// Particle-steps per second of the explicit step on a cube of 50^3 particles in slow torsion, for each kind of membrane, breakable or not,
// with boundary particles and cells, on one thread and on two. Arguments: those of Google Benchmark.
#include <plan/plan.hpp>
#include <run/state.hpp>

#include <benchmark/benchmark.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace {
using namespace hyperlattice;

constexpr const char* membranes[] = {"none", "III", "I-m"};  // none, clamped, free

nlohmann::json scene_of(const std::string& membrane, bool breakable, bool cells) {
  nlohmann::json material = {{"type", "materials.elastic"}, {"young", 1e10}, {"density", 2500}, {"membrane", membrane}};
  if (membrane != "none") material["lambda"] = 0.5;
  if (breakable) material["failure"] = {{"type", "failures.elongation"}, {"limit", 1e-4}};  // is never reached
  const auto spin = [](const char* low, const char* high, double rate) {
    return nlohmann::json{{"type", "loads.start_velocity"},
                          {"on", {{"box", {{"low", {0, 0, low}}, {"high", {"50 mm", "50 mm", high}}}}}},
                          {"angular", {0, 0, rate}},
                          {"centre", {"25 mm", "25 mm", 0}}};
  };
  const char* size = cells ? "49 mm" : "50 mm";
  return {{"format", "hyperlattice/1"},
          {"pipeline",
           {{{"type", "lattices.cubic"},
             {"spacing", "1 mm"},
             {"boundary", cells ? "cells" : "particles"},
             {"shape", {{"box", {{"low", {0, 0, 0}}, {"high", {size, size, size}}}}}}},
            material,
            spin("0 mm", "25 mm", 1),
            spin("25 mm", "50 mm", -1),
            {{"type", "solvers.explicit"}, {"end_time", "1 s"}}}}};
}

void explicit_step(benchmark::State& state) {
  const auto file = std::filesystem::temp_directory_path() / ("kernels_benchmark." + std::to_string(getpid()) + ".json");
  std::ofstream(file) << scene_of(membranes[state.range(0)], state.range(1) != 0, state.range(2) != 0);
  Host host({std::filesystem::path(HYPERLATTICE_BUILD) / "lib" / "hyperlattice"});
  const int threads = static_cast<int>(state.range(3));
  const auto plan = make_plan(read_scene(file, {}, host), threads);
  std::filesystem::remove(file);

  Simulation simulation(*plan->model, threads);
  for (auto _ : state) simulation.step(plan->stages.front().plan.time_step);
  const auto particles = static_cast<double>(plan->model->body.particles);
  state.counters["particle_steps/s"] = benchmark::Counter(particles, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["s/particle_step"] = benchmark::Counter(particles, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.SetLabel(std::string(membranes[state.range(0)]) + (state.range(1) != 0 ? ", breakable, " : ", ") + (state.range(2) != 0 ? "cells, " : "") +
                 plan->model->kernels.instructions);
}
BENCHMARK(explicit_step)
    ->ArgNames({"membrane", "breakable", "cells", "threads"})
    ->ArgsProduct({{0, 1, 2}, {0, 1}, {0, 1}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
