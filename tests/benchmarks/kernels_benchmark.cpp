// Speed of the explicit step for each kind of kernel, precision, size and shape: nanoseconds per
// particle-step, springs per second, and the fraction of the processor's peak arithmetic.
// Arguments: those of Google Benchmark, for instance --benchmark_filter=free/float/50.
#include <plan/plan.hpp>
#include <state/simulation.hpp>

#include <benchmark/benchmark.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <filesystem>
#include <fstream>

namespace {
using namespace hyperlattice;
using Json = nlohmann::json;

struct Variant {
  const char* name;
  const char* membrane;
  bool breakable, damped, cells;
  /// Operations in kernels/stencil.hpp and kernels/motion.hpp; a root counts with its series.
  int flops_of_spring, flops_of_particle;
  const char* law = "materials.elastic";
  /// Law of the upper half of the body, or of its half in every row of particles, so that a part of
  /// each row has several laws; null: the body has one law.
  const char* second_law = nullptr;
  bool in_every_row = false;
};
const Variant variants[] = {
    {"three", "none", false, false, false, 33, 18},
    {"three_breakable", "none", true, false, false, 33, 18},
    {"three_damped", "none", false, true, false, 33, 39},
    {"three_cells", "none", false, false, true, 33, 18},
    {"clamped", "III", false, false, false, 47, 18},
    {"clamped_breakable", "III", true, false, false, 47, 18},
    {"free", "I-m", false, false, false, 61, 27},
    {"free_breakable", "I-m", true, false, false, 61, 27},
    {"free_damped", "I-m", false, true, false, 61, 55},
    {"free_cells", "I-m", false, false, true, 61, 27},
    {"viscous", "none", false, false, false, 33, 18, "materials.viscous"},
    {"elastic_and_viscous_rows", "none", false, false, false, 33, 18, "materials.elastic",
     "materials.viscous"},
    {"elastic_and_viscous_in_rows", "none", false, false, false, 33, 18, "materials.elastic",
     "materials.viscous", true},
};

/// A cube of `size` particles along an edge, or the hollow sphere of 490,432 particles (size 0), in
/// slow torsion.
Json scene_of(const Variant& variant, int size, const char* precision) {
  const auto material_of = [&](const char* law) {
    Json material = {
        {"type", law}, {"young", 1e10}, {"density", 2500}, {"membrane", variant.membrane}};
    if (std::string(law) == "materials.viscous") material["time"] = "1 ns";
    return material;
  };
  Json material = material_of(variant.law);
  if (std::string(variant.membrane) != "none") material["lambda"] = 0.5;
  if (variant.breakable)
    material["failure"] = {{"type", "failures.elongation"}, {"limit", 1e-4}};  // never reached
  const double edge = (variant.cells ? size - 1 : size) * 1e-3, far = 1;
  const Json ball = {{"sphere", {{"radius", 0.05}}}}, cavity = {{"sphere", {{"radius", 0.02}}}};
  const Json shape = size > 0 ? Json{{"box", {{"low", {0, 0, 0}}, {"high", {edge, edge, edge}}}}}
                              : Json{{"difference", {ball, cavity}}};
  const auto spin = [&](double low, double high, double rate) {
    return Json{{"type", "loads.start_velocity"},
                {"on", {{"box", {{"low", {-far, -far, low}}, {"high", {far, far, high}}}}}},
                {"angular", {0, 0, rate}},
                {"centre", {edge / 2, edge / 2, 0}}};
  };
  const double middle = size > 0 ? edge / 2 : 0;
  Json pipeline = {{{"type", "lattices.cubic"},
                    {"spacing", 1e-3},
                    {"boundary", variant.cells ? "cells" : "particles"},
                    {"shape", shape}},
                   material};
  if (variant.second_law != nullptr) {
    Json second = material_of(variant.second_law);
    const Json low = variant.in_every_row ? Json{middle, -far, -far} : Json{-far, -far, middle};
    second["region"] = {{"box", {{"low", low}, {"high", {far, far, far}}}}};
    pipeline.push_back(second);
  }
  pipeline.push_back(spin(-far, middle, 1));
  pipeline.push_back(spin(middle, far, -1));
  pipeline.push_back({{"type", "solvers.explicit"}, {"end_time", "1 ms"}});
  return {{"format", "hyperlattice/1"}, {"precision", precision}, {"pipeline", pipeline}};
}

/// Multiply-adds in registers of one thread, flops per second, measured at the start.
template <class Real>
[[gnu::always_inline]] inline double peak_of_multiply_adds() {
  constexpr int chains = 12 * 64 / sizeof(Real), rounds = 200000;
  Real x[chains];
  for (int n = 0; n < chains; ++n) x[n] = static_cast<Real>(n);
  const auto start = std::chrono::steady_clock::now();
  for (int round = 0; round < rounds; ++round)
    for (Real& value : x) value = value * static_cast<Real>(0.999) + static_cast<Real>(1e-3);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  benchmark::DoNotOptimize(x);
  return 2.0 * chains * rounds / time.count();
}
#if defined(__x86_64__)
#define FOR_THIS_PROCESSOR \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define FOR_THIS_PROCESSOR
#endif
FOR_THIS_PROCESSOR double peak_of_doubles() { return peak_of_multiply_adds<double>(); }
FOR_THIS_PROCESSOR double peak_of_floats() { return peak_of_multiply_adds<float>(); }

void explicit_step(benchmark::State& state, const Variant& variant, int size, const char* precision,
                   int threads) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("kernels_benchmark." + std::to_string(getpid()) + ".json");
  std::ofstream(file) << scene_of(variant, size, precision);
  Host host({std::filesystem::path(HYPERLATTICE_BUILD) / "lib" / "hyperlattice"});
  const auto plan = make_plan(read_scene(file, {}, host), threads);
  std::filesystem::remove(file);

  Simulation simulation(*plan->model, threads);
  if (variant.damped) simulation.set_damping(0.8);
  const double time_step = 0.5 * plan->stages.front().plan.time_step;
  simulation.step(time_step);  // the first step also starts the energy balance
  for (auto _ : state) simulation.step(time_step);
  const auto particles = static_cast<double>(plan->model->body.particles),
             springs = static_cast<double>(plan->model->body.base_springs());
  const double flops = springs * variant.flops_of_spring + particles * variant.flops_of_particle;
  const double peak = plan->model->springs.choice.precision == Precision::floats
                          ? peak_of_floats()
                          : peak_of_doubles();
  using benchmark::Counter;
  state.counters["s/particle_step"] =
      Counter(particles, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["springs/s"] = Counter(springs, Counter::kIsIterationInvariantRate);
  state.counters["of_peak"] = Counter(flops / (peak * threads), Counter::kIsIterationInvariantRate);
  state.SetLabel(plan->model->springs.kernels().instructions);
}

void add(const Variant& variant, int size, const char* precision, int threads) {
  const std::string shape = size > 0 ? std::to_string(size) : "hollow_sphere";
  const std::string name =
      std::string(variant.name) + "/" + precision + "/" + shape + "/" + std::to_string(threads);
  auto* added = benchmark::RegisterBenchmark(
      name.c_str(), [&variant, size, precision, threads](benchmark::State& state) {
        explicit_step(state, variant, size, precision, threads);
      });
  added->Unit(benchmark::kMillisecond);
  // One thread is measured by its own time, because other programs may be at work.
  if (threads > 1) added->UseRealTime();
}

}  // namespace

int main(int argc, char** argv) {
  for (const Variant& variant : variants)
    for (const int size : {25, 50, 100, 0})
      if (size > 0 || !variant.cells)
        for (const char* precision : {"double", "float"})
          for (const int threads : {1, 2})
            if (variant.second_law == nullptr || std::string(precision) == "double")
              add(variant, size, precision, threads);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
