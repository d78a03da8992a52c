// The contract of failure criteria: springs below their alarm do not break, springs break at the
// threshold that the criterion states, and broken springs do not heal.
#include <contract/families.hpp>
#include <scene/stage_call.hpp>

#include <hyperlattice/failure.hpp>

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <optional>

namespace hyperlattice::contract {
namespace {

/// The failure criterion of a model, evaluated for one spring at a time.
class Criterion {
 public:
  explicit Criterion(const Model& model)
      : model_(model),
        material_(model.materials.front()),
        functions_(material_.failure_stage->functions<FailureFunctions>()) {}

  /// Returns one entry for each class of base springs.
  std::vector<SpringFacts> springs() const {
    std::vector<SpringFacts> all;
    for (const NeighbourGeometry& neighbour : model_.neighbours) {
      const std::uint32_t spring_class = neighbour.site.spring_class;
      if (spring_class != all.size()) continue;
      all.push_back({neighbour.rest_length, model_.spring(0, 0, spring_class).stiffness,
                     model_.body.grid.spacing, spring_class, model_.crossings});
    }
    return all;
  }
  double alarm(const SpringFacts& spring) const {
    double alarm = 0;
    call(*material_.failure_stage, "alarm", [&](const Complaint& why) {
      return functions_.alarm(material_.failure.get(), spring, alarm, why);
    });
    return alarm;
  }
  bool breaks(const SpringFacts& spring, double elongation, Particle other = 1,
              double rate = 0) const {
    const Particle first = 0;
    SpringBatch batch{0, spring, {&elongation, 1}, {}, {}, {}};
    if (functions_.asks_ends) {
      batch.a = {&first, 1};
      batch.b = {&other, 1};
    }
    if (functions_.asks_rate) batch.rate = {&rate, 1};
    std::uint8_t broken = 0;
    call(*material_.failure_stage, "breaks", [&](const Complaint& why) {
      return functions_.review(material_.failure.get(), batch, &broken, why);
    });
    return broken != 0;
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
  const Material& material_;
  const FailureFunctions& functions_;
};

Finding alarm_is_conservative(const Criterion& criterion) {
  constexpr int pieces = 200;
  constexpr double rates[] = {-1e3, -1, 0, 1, 1e3};  // m/s
  std::string alarms;
  for (const SpringFacts& spring : criterion.springs()) {
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
          if (criterion.breaks(spring, elongation, other, rate))
            return passes_if(false, fmt::format("breaks a spring of class {} at {:.6g} m, below "
                                                "its alarm of {:.6g} m: a run would never ask",
                                                spring.spring_class, elongation, alarm));
    }
  }
  return passes_if(true, "nothing breaks below " + alarms);
}

/// Moves two particles just below and just above the threshold, and checks whether their spring
/// breaks there.
Finding breaks_at_the_criterion(const Model& model, double threshold) {
  DrivenBody pair(model);
  Simulation& simulation = pair.simulation();
  const double step = 1e-3 * model.critical_time_step;
  const auto at = [&](double factor) {
    std::vector<double> u(3 * model.body.particles, 0.0);
    u[3] = factor * threshold;
    const double pull = pair.forces(u, step)[0];
    return std::pair{pull, simulation.breakages().size()};
  };
  if (at(1 - 1e-6).second != 0)
    return passes_if(false,
                     fmt::format("the spring of two particles is gone before {:.6g} m", threshold));
  if (at(1 + 1e-6).second != 1)
    return passes_if(false,
                     fmt::format("the spring of two particles holds beyond {:.6g} m", threshold));
  const double elongation = simulation.breakages().front().elongation;
  return passes_if(std::abs(elongation / threshold - 1) < 1e-5,
                   fmt::format("at {:.6g} m, logged as {:.6g} m", threshold, elongation));
}

Finding stays_broken(const Model& model, double threshold) {
  DrivenBody pair(model);
  const double step = 1e-3 * model.critical_time_step;
  double pull = 0;
  for (const double factor : {1.01, 0.5, -0.5, 0.0, 1.5, 0.9}) {
    std::vector<double> u(3 * model.body.particles, 0.0);
    u[3] = factor * threshold;
    const double now = std::abs(pair.forces(u, step)[0]);
    if (factor != 1.01) take_largest(pull, now);
  }
  const std::size_t breakages = pair.simulation().breakages().size();
  return passes_if(
      pull == 0 && breakages == 1,
      fmt::format(
          "led back, compressed and pulled again, it pulls with {:.3g} N and broke {} time{}", pull,
          breakages, breakages == 1 ? "" : "s"));
}

Finding takes_its_energy(const Model& model, double threshold) {
  const double stiffness = model.spring(0, 0, model.neighbours.front().site.spring_class).stiffness;
  const double expected = 0.5 * stiffness * threshold * threshold;
  Simulation simulation(model, 1);
  std::vector<double> u(3 * model.body.particles, 0.0);
  u[3] = threshold * (1 + 1e-9);
  simulation.set_displacements(u, {});
  simulation.balance();
  simulation.step(1e-6 * model.critical_time_step);
  const double taken = simulation.balance().dissipated_failure;
  return passes_if(std::abs(taken / expected - 1) < 1e-6,
                   fmt::format("{:.4g} J are counted as dissipated, {:.4g} J were in the spring",
                               taken, expected));
}

Finding same_bits(const Model& model, double threshold) {
  RandomMotion motion{threshold / model.critical_time_step};  // moves by a threshold in a step
  const MotionResult one = run_motion(model, motion);
  motion.threads = 3;
  const MotionResult three = run_motion(model, motion);
  return passes_if(one.is_finite() && one.hash == three.hash && one.balance.dissipated_failure > 0,
                   fmt::format("with 1 and 3 threads, while springs with {:.3g} J break",
                               one.balance.dissipated_failure));
}

Finding restart(const Model& model, double threshold) {
  RandomMotion motion{threshold / model.critical_time_step};
  const MotionResult whole = run_motion(model, motion);
  motion.cut_off = true;
  const MotionResult cut_off = run_motion(model, motion);
  return passes_if(whole.is_finite() && cut_off.hash == whole.hash &&
                       cut_off.balance.dissipated_failure == whole.balance.dissipated_failure,
                   "the same springs break when it is cut off half-way and goes on");
}

}  // namespace

void check_failure(Trial& trial) {
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
  const std::optional<double> threshold = one.threshold(one.springs().front());

  trial.check("alarm is conservative", [&] { return alarm_is_conservative(all); });
  trial.check("breaks at the criterion", [&] {
    return threshold ? breaks_at_the_criterion(*pair->model, *threshold)
                     : passes_if(false, "a spring holds up to ten times its length");
  });
  if (!threshold) return;
  trial.check("stays broken", [&] { return stays_broken(*pair->model, *threshold); });
  trial.check("takes the spring's energy",
              [&] { return takes_its_energy(*pair->model, *threshold); });
  trial.check("same bits", [&] { return same_bits(*block->model, *threshold); });
  trial.check("restart", [&] { return restart(*block->model, *threshold); });
}

}  // namespace hyperlattice::contract
