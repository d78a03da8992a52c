// Speed of a step of a random lattice, compared with the simplest program for it: one scalar pass
// over a list of springs in the order of the particles, each spring once. The two alternate,
// because the speed of machines changes from second to second. `of_scalar_list` is the median ratio
// of their times, above 1 if the scalar list is slower. Arguments: those of Google Benchmark.
#include <support/lists.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>

namespace {
using namespace hyperlattice;

struct Variant {
  const char* name;
  const char* material;
};
const Variant variants[] = {
    {"three", R"("membrane": "none")"},
    // The limit is never reached.
    {"three_breakable",
     R"("membrane": "none", "failure": { "type": "failures.elongation", "limit": 1e-4 })"},
    {"clamped", R"("membrane": "III", "lambda": 0.5)"},
    {"free", R"("membrane": "I", "lambda": 0.5)"},
};

/// The same body with linear springs in three dimensions: one record per particle and one per
/// spring.
class ScalarList {
 public:
  ScalarList(const Model& model, const std::vector<double>& displacements)
      : inverse_mass_(1 / model.materials[0].mass) {
    for (Particle p = 0; p < model.body.particles; ++p)
      points_.push_back(
          {model.body.position(p) +
               Vec3{displacements[3 * p], displacements[3 * p + 1], displacements[3 * p + 2]},
           {},
           {}});
    for (std::uint32_t n = 0; n < model.body.listed.springs.size(); ++n) {
      const ListedSpring& spring = model.body.listed.springs[n];
      const SpringProperties properties = model.spring_properties(spring.a, spring.b, n);
      springs_.push_back({spring.a, spring.b, properties.rest_length, properties.stiffness});
    }
  }

#if defined(__x86_64__)
  __attribute__((target_clones("arch=x86-64-v3", "default")))
#endif
  void
  step(double kick, double drift) {
    for (const Spring& spring : springs_) {
      Point &a = points_[spring.a], &b = points_[spring.b];
      const double x = b.place.x - a.place.x, y = b.place.y - a.place.y, z = b.place.z - a.place.z;
      const double pull =
          spring.stiffness * (1 - spring.length / __builtin_sqrt(x * x + y * y + z * z));
      const Vec3 force{pull * x, pull * y, pull * z};
      a.force = a.force + force;
      b.force = b.force - force;
    }
    for (Point& point : points_) {
      point.velocity = point.velocity + kick * inverse_mass_ * point.force;
      point.place = point.place + drift * point.velocity;
      point.force = {};
    }
  }

  Vec3 place(Particle particle) const { return points_[particle].place; }

 private:
  struct Point {
    Vec3 place, velocity, force;
  };
  struct Spring {
    std::uint32_t a, b;
    double length, stiffness;
  };
  std::vector<Point> points_;
  std::vector<Spring> springs_;
  double inverse_mass_;
};

/// Largest difference of the positions after both have moved from the same start.
double difference(const Model& model, const Simulation& ours, const ScalarList& scalar) {
  const std::vector<double> moved = test::displacements(ours);
  double largest = 0;
  for (Particle p = 0; p < model.body.particles; ++p)
    largest = std::max(largest, norm(scalar.place(p) - model.body.position(p) -
                                     Vec3{moved[3 * p], moved[3 * p + 1], moved[3 * p + 2]}));
  return largest;
}

/// Seconds of this thread's own time, because other programs may be at work.
template <class Work>
double seconds(const Work& work) {
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  const double start = now();
  work();
  return now() - start;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void compare(benchmark::State& state, const Variant& variant, const std::string& precision,
             int size) {
  const std::string scene =
      test::listed_scene(test::random_lattice(size, size, size), variant.material);
  const bool floats = precision == "float";
  const auto plan = test::plan_of(floats ? test::in_floats(scene) : scene);
  const Model& model = *plan->model;
  const double amplitude = 1e-3 * model.body.grid.spacing, step = 0.5 * model.step_limit.time_step;
  const std::vector<double> start = test::noise(3 * model.body.particles, amplitude);
  Simulation ours(model, 1);
  ScalarList scalar(model, start);
  ours.set_displacements(start, {});
  ours.step(step);
  scalar.step(step / 2, step);  // velocities are half a step behind
  ours.step(step);
  scalar.step(step, step);
  const double exact = floats ? 1e-5 : 1e-9;
  if (model.springs.choice.membrane == KernelChoice::Membrane::none &&
      !(difference(model, ours, scalar) < exact * amplitude))
    return state.SkipWithError("the trajectories differ: nothing to compare");

  const int steps = std::max(1, 100000 * 4 / static_cast<int>(model.body.particles));
  std::vector<double> times, of_scalar, ratios;
  for (auto _ : state) {
    times.push_back(seconds([&] {
      for (int n = 0; n < steps; ++n) ours.step(step);
    }));
    of_scalar.push_back(seconds([&] {
      for (int n = 0; n < steps; ++n) scalar.step(step, step);
    }));
    ratios.push_back(of_scalar.back() / times.back());
  }
  const double work = static_cast<double>(model.body.particles) * steps,
               springs = static_cast<double>(model.body.base_springs());
  const double nanoseconds = 1e9 * median(times) / work,
               scalar_nanoseconds = 1e9 * median(of_scalar) / work;
  state.counters["ns/particle_step"] = nanoseconds;
  state.counters["ns/spring"] = nanoseconds * static_cast<double>(model.body.particles) / springs;
  state.counters["scalar_ns"] = scalar_nanoseconds;
  state.counters["of_scalar_list"] = median(ratios);
  state.counters["bytes"] = plan->bytes_per_particle;
  state.SetLabel(model.springs.kernels().instructions);
}

}  // namespace

int main(int argc, char** argv) {
  for (const Variant& variant : variants)
    for (const std::string precision : {"double", "float"})
      for (const int size : {25, 50, 100}) {
        const std::string name =
            std::string(variant.name) + "/" + precision + "/" + std::to_string(size);
        auto* added = benchmark::RegisterBenchmark(
            name.c_str(), [&variant, precision, size](benchmark::State& state) {
              compare(state, variant, precision, size);
            });
        added->Unit(benchmark::kMillisecond);
      }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
