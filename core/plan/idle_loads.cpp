#include <plan/idle_loads.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace hyperlattice {
namespace {

/// Returns whether the load has forces or displacements for its factor to multiply.
bool pushes(const Load& load) {
  return std::any_of(load.particles.begin(), load.particles.end(),
                     [](const LoadedParticle& loaded) {
                       return !(loaded.force == Vec3{}) || !(loaded.displacement == Vec3{});
                     });
}
bool drives(const Load& load) {
  return std::any_of(load.particles.begin(), load.particles.end(),
                     [](const LoadedParticle& loaded) { return !(loaded.velocity == Vec3{}); });
}

/// Returns whether the load changes a state of rest: by its factor at the stage's end, or by the
/// distance over which it drives particles until then.
bool acts_at_rest(const Load& load, const PlannedStage& stage) {
  const double end = stage.plan.end_time;
  return (pushes(load) && load.after(end) != 0) ||
         (drives(load) && load.integral(stage.start_time, end) != 0);
}

bool acts_in_time(const Load& load, const PlannedStage& stage, int windows) {
  const double start = stage.start_time, length = stage.plan.end_time - start;
  for (int n = 0; n < windows; ++n)
    if (load.mean(start + length * n / windows, start + length * (n + 1) / windows) != 0)
      return true;
  return false;
}

}  // namespace

void warn_of_idle_loads(Plan& plan) {
  const auto windows =
      static_cast<int>(std::clamp<std::size_t>(20'000 / (1 + plan.model->loads.size()), 4, 1000));
  for (const Load& load : plan.model->loads) {
    if (!pushes(load) && !drives(load)) continue;
    const bool acts =
        std::any_of(plan.stages.begin(), plan.stages.end(), [&](const PlannedStage& stage) {
          return stage.plan.at_rest ? acts_at_rest(load, stage)
                                    : acts_in_time(load, stage, windows);
        });
    if (acts) continue;
    const PlannedStage& last = plan.stages.back();
    plan.model->warnings.push_back(fmt::format(
        "{} ({}): it does nothing in this run. {}", load.stage->component->type(),
        load.stage->pointer,
        last.plan.at_rest
            ? fmt::format("{} looks for rest under the loads of {:.6g} s, where it has no effect: "
                          "give another end_time",
                          last.stage->pointer, last.plan.end_time)
            : fmt::format("It is zero from the start to the end at {:.6g} s", last.plan.end_time)));
  }
}

}  // namespace hyperlattice
