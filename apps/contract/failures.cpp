// The contract of failure criteria: springs below their alarm do not break, springs break at the
// threshold that the criterion states, and broken springs do not heal. A criterion with memory is
// asked about springs that are pulled and released several times.
#include <contract/families.hpp>
#include <scene/stage_call.hpp>

#include <hyperlattice/failure.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace hyperlattice::contract {
namespace {

/// How often a spring is pulled to find out whether it breaks, and the lengths of steps, s. A pull
/// lasts one short step, in which the spring moves hardly; then it is released for two long steps.
struct Pulling {
  int pulls = 1;
  double pull = 0, release = 0;
};

/// The failure criterion of a model, evaluated for one spring at a time.
class Criterion {
 public:
  explicit Criterion(const Model& model)
      : model_(model),
        criterion_(model.materials.front().failures.front()),
        functions_(criterion_.stage->functions<FailureFunctions>()) {}

  bool remembers() const { return functions_.memory > 0; }
  Pulling pulling() const {
    return {remembers() ? 5 : 1, 1e-6 * model_.step_limit.time_step, model_.step_limit.time_step};
  }
  /// Returns one entry for each class of base springs.
  std::vector<SpringFacts> springs() const {
    std::vector<SpringFacts> all;
    for (const NeighbourGeometry& neighbour : model_.springs.neighbours) {
      const std::uint32_t spring_class = neighbour.site.spring_class;
      if (spring_class != all.size()) continue;
      all.push_back({neighbour.rest_length, model_.springs.spring(0, 0, spring_class).stiffness,
                     model_.body.grid.spacing, spring_class, model_.springs.crossings});
    }
    return all;
  }
  double alarm(const SpringFacts& spring) const {
    double alarm = 0;
    call(*criterion_.stage, "alarm", [&](const Complaint& why) {
      return functions_.alarm(criterion_.component.get(), spring, alarm, why);
    });
    return alarm;
  }
  /// The numbers that the criterion keeps for a spring.
  using Memory = std::array<double, max_failure_memory>;
  Memory start() const { return criterion_.start; }
  bool breaks(const SpringFacts& spring, const AlarmedSpring& state, Memory& memory) const {
    SpringBatch batch{state.time, spring, {&state.elongation, 1}, {},
                      {},         {},     memory.data(),          state.time_step};
    if (functions_.asks_ends) {
      batch.a = {&state.a, 1};
      batch.b = {&state.b, 1};
    }
    if (functions_.asks_rate) batch.rate = {&state.rate, 1};
    std::uint8_t broken = 0;
    call(*criterion_.stage, "breaks", [&](const Complaint& why) {
      return functions_.review(criterion_.component.get(), batch, &broken, why);
    });
    return broken != 0;
  }
  /// Returns whether the spring to particle `other` breaks when it is pulled to `elongation` as
  /// often as pulling() says.
  bool breaks(const SpringFacts& spring, double elongation, Particle other = 1) const {
    const Pulling how = pulling();
    const double least = alarm(spring);
    Memory memory = start();
    AlarmedSpring state{0, 0, 0, other, 0, 0};
    const auto step = [&](double to, double length) {
      state.elongation = to;
      const bool broken = to > least && breaks(spring, state, memory);
      state.time += length;
      state.time_step = length;
      return broken;
    };
    if (!remembers()) return breaks(spring, {0, elongation, 0, other, 0, 0}, memory);
    for (int n = 0; n < how.pulls; ++n)
      if (step(elongation, how.pull) || step(0, how.release) || step(0, how.release)) return true;
    return false;
  }
  /// Returns the elongation, m, at which the spring to particle `other` breaks; nothing if it holds
  /// up to ten times its length.
  std::optional<double> threshold(const SpringFacts& spring, Particle other = 1) const {
    double low = 0, high = 1e-7 * spring.rest_length;
    while (!breaks(spring, high, other)) {
      low = high;
      high *= 1.05;
      if (high > 10 * spring.rest_length) return std::nullopt;
    }
    for (int n = 0; n < 100 && high > low * (1 + 1e-14); ++n)
      (breaks(spring, 0.5 * (low + high), other) ? high : low) = 0.5 * (low + high);
    return high;
  }

 private:
  const Model& model_;
  const Material::Criterion& criterion_;
  const FailureFunctions& functions_;
};

/// Two particles whose spring is pulled.
class Pair {
 public:
  Pair(const Model& model, Pulling how) : model_(model), how_(how), driven_(model) {}

  /// Pulls the spring to `elongation`, m, as often as needed to break it, but not more often than
  /// `how` says. Returns the number of pulls that it held.
  int pull(double elongation) {
    int held = 0;
    while (held < how_.pulls && !breaks_at(elongation)) {
      ++held;
      release();
    }
    return held;
  }
  /// Moves the spring to an elongation for a short step. Returns the force on one particle, N.
  double at(double elongation) { return driven_.forces(moved(elongation), how_.pull)[0]; }
  void release() {
    for (int n = 0; n < 2 && how_.pulls > 1; ++n) driven_.forces(moved(0), how_.release);
  }
  Simulation& simulation() { return driven_.simulation(); }

 private:
  bool breaks_at(double elongation) {
    at(elongation);
    return !simulation().breakages().empty();
  }
  std::vector<double> moved(double elongation) const {
    std::vector<double> u(3 * model_.body.particles, 0.0);
    u[3] = elongation;
    return u;
  }

  const Model& model_;
  Pulling how_;
  DrivenBody driven_;
};

Finding alarm_is_conservative(const Criterion& criterion) {
  constexpr int pieces = 200;
  constexpr double rates[] = {-1e3, -1, 0, 1, 1e3};  // m/s
  std::string alarms;
  for (const SpringFacts& spring : criterion.springs()) {
    Criterion::Memory memory = criterion.start();  // of a spring with a long history
    const double alarm = criterion.alarm(spring),
                 highest = std::min(alarm, 10 * spring.rest_length),
                 lowest = -0.9 * spring.rest_length;
    if (std::isnan(alarm))
      return passes_if(false,
                       fmt::format("the alarm of class {} is no number", spring.spring_class));
    alarms += fmt::format("{}{:.3g} m", alarms.empty() ? "" : ", ", alarm);
    for (int n = 0; n < pieces; ++n) {
      const double elongation = n == 0       ? highest
                                : n % 2 == 0 ? lowest + (highest - lowest) * n / pieces
                                             : highest * n / pieces;
      for (Particle other = 1; elongation <= highest && other <= 20; ++other)
        for (const double rate : rates)
          if (criterion.breaks(spring, {1.0 * n, elongation, 0, other, rate, 1}, memory))
            return passes_if(false, fmt::format("breaks a spring of class {} at {:.6g} m, below "
                                                "its alarm of {:.6g} m: a run would never ask",
                                                spring.spring_class, elongation, alarm));
    }
  }
  return passes_if(true, "nothing breaks below " + alarms);
}

/// Pulls two particles to just below and to just above the threshold, and checks whether their
/// spring breaks there.
Finding breaks_at_the_criterion(const Model& model, const Pulling& how, double threshold) {
  if (Pair below(model, how); below.pull((1 - 1e-6) * threshold) < how.pulls)
    return passes_if(false,
                     fmt::format("the spring of two particles is gone before {:.6g} m", threshold));
  Pair above(model, how);
  if (above.pull((1 + 1e-6) * threshold) == how.pulls)
    return passes_if(false,
                     fmt::format("the spring of two particles holds beyond {:.6g} m", threshold));
  const double elongation = above.simulation().breakages().front().elongation;
  return passes_if(std::abs(elongation / threshold - 1) < 1e-5,
                   fmt::format("at {:.6g} m, logged as {:.6g} m", threshold, elongation));
}

Finding stays_broken(const Model& model, const Pulling& how, double threshold) {
  Pair pair(model, how);
  pair.pull(1.01 * threshold);
  double pull = 0;
  for (const double share : {0.5, -0.5, 0.0, 1.5, 0.9})
    take_largest(pull, pair.at(share * threshold));
  const std::size_t breakages = pair.simulation().breakages().size();
  return passes_if(
      pull == 0 && breakages == 1,
      fmt::format(
          "led back, compressed and pulled again, it pulls with {:.3g} N and broke {} time{}", pull,
          breakages, breakages == 1 ? "" : "s"));
}

Finding takes_its_energy(const Model& model, const Pulling& how, double threshold) {
  const double stiffness =
      model.springs.spring(0, 0, model.springs.neighbours.front().site.spring_class).stiffness;
  const double expected = 0.5 * stiffness * threshold * threshold;
  Pair pair(model, how);
  pair.pull(threshold * (1 + 1e-9));
  const double taken = pair.simulation().balance().dissipated_failure;
  return passes_if(std::abs(taken / expected - 1) < 1e-6,
                   fmt::format("{:.4g} J are counted as dissipated, {:.4g} J were in the spring",
                               taken, expected));
}

/// Asks twice about a spring with the same random history, and checks the numbers that are kept.
Finding memory_is_sound(const Criterion& criterion, double threshold) {
  const SpringFacts spring = criterion.springs().front();
  const double least = criterion.alarm(spring), step = criterion.pulling().release;
  const std::vector<double> elongations = noise(1000, 2 * threshold);
  std::vector<Criterion::Memory> kept;
  std::vector<bool> answers;
  for (int time = 0; time < 2; ++time) {
    Criterion::Memory memory = criterion.start();
    for (std::size_t n = 0; n < elongations.size(); ++n) {
      if (!(elongations[n] > least)) continue;
      answers.push_back(criterion.breaks(
          spring, {static_cast<double>(n) * step, elongations[n], 0, 1, 0, n == 0 ? 0 : step},
          memory));
      kept.push_back(memory);
    }
  }
  const auto half = static_cast<std::ptrdiff_t>(kept.size() / 2);
  for (const Criterion::Memory& memory : kept)
    for (const double number : memory)
      if (std::isnan(number)) return passes_if(false, "a number of it is no number (nan)");
  return passes_if(
      std::equal(kept.begin(), kept.begin() + half, kept.begin() + half) &&
          std::equal(answers.begin(), answers.begin() + half, answers.begin() + half),
      fmt::format("asked {} times about the same history, it answers and keeps the same", half));
}

}  // namespace

Finding same_bits_while_failing(const Model& model, RandomMotion motion) {
  const MotionResult one = run_motion(model, motion);
  motion.threads = 3;
  const MotionResult three = run_motion(model, motion);
  return passes_if(one.is_finite() && one.hash == three.hash && one.balance.dissipated_failure > 0,
                   fmt::format("with 1 and 3 threads, while failure takes {:.3g} J",
                               one.balance.dissipated_failure));
}

Finding restart_while_failing(const Model& model, RandomMotion motion) {
  const MotionResult whole = run_motion(model, motion);
  motion.cut_off = true;
  const MotionResult cut_off = run_motion(model, motion);
  return passes_if(whole.is_finite() && cut_off.hash == whole.hash &&
                       cut_off.balance.dissipated_failure == whole.balance.dissipated_failure,
                   "the same failure when it is cut off half-way and goes on");
}

void check_failure(Trial& trial) {
  if (static_cast<const FailureFunctions*>(trial.component.info.functions)->surface.ratios !=
      nullptr)
    return check_surface(trial);
  const auto with = [&](Json material) {
    material["failure"] = trial.example;
    return material;
  };
  const Scenes& scenes = trial.scenes;
  const auto pair = scenes.plan_of({scenes.grid_box(2, 1, 1), with(scenes.material())});
  const auto cell = scenes.plan_of({scenes.grid_box(2, 2, 2), with(scenes.material())});
  const auto block =
      scenes.plan_of({scenes.grid_box(5, 4, 6), with(scenes.material(usual_membrane))});
  const Criterion all(*cell->model), one(*pair->model);
  const Pulling how = one.pulling();
  const std::optional<double> threshold = one.threshold(one.springs().front());

  trial.check("alarm is conservative", [&] { return alarm_is_conservative(all); });
  trial.check("breaks at the criterion", [&] {
    return threshold ? breaks_at_the_criterion(*pair->model, how, *threshold)
                     : passes_if(false, fmt::format("a spring holds {} pull{} to ten times its "
                                                    "length",
                                                    how.pulls, how.pulls == 1 ? "" : "s"));
  });
  if (!threshold) return;
  trial.check("stays broken", [&] { return stays_broken(*pair->model, how, *threshold); });
  trial.check("takes the spring's energy",
              [&] { return takes_its_energy(*pair->model, how, *threshold); });
  if (one.remembers()) trial.check("memory", [&] { return memory_is_sound(one, *threshold); });
  // Particles move by the threshold within a step.
  const RandomMotion motion{*threshold / block->model->step_limit.time_step};
  trial.check("same bits", [&] { return same_bits_while_failing(*block->model, motion); });
  trial.check("restart", [&] { return restart_while_failing(*block->model, motion); });
}

}  // namespace hyperlattice::contract
