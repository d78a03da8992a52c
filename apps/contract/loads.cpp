// The contract of loads: the load factor is finite at all times, and the injected energy is the
// work that the body receives.
#include <contract/families.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice::contract {
namespace {

Finding factor(const Model& model) {
  const Load& load = model.loads[0];
  double least = infinity, most = -infinity;
  for (int n = 0; n <= 1000; ++n) {
    const double time = 1e-7 * n, now = load.factor(time);
    if (!std::isfinite(now) || load.factor(time) != now)
      return passes_if(false,
                       fmt::format("at {:.3g} s it is no number, or not twice the same", time));
    least = std::min(least, now);
    most = std::max(most, now);
  }
  return passes_if(true, fmt::format("{:.4g} to {:.4g} in the first 0.1 ms", least, most));
}

/// Checks the error of the energy balance at two time steps. Errors of central differences are of
/// second order in the step; with loads that depend on velocities, of first order.
Finding work(const Model& model) {
  const MotionResult coarse = run_motion(model, {0.5, 0.4}), fine = run_motion(model, {0.5, 0.1});
  const double power = model.loads.answering ? 2.5 : 8;
  return passes_if(coarse.largest_error < 0.02 &&
                       fine.largest_error < std::max(1e-9, coarse.largest_error / power),
                   fmt::format("a block in motion gets {:.3g} J; relative error of the energy "
                               "balance {:.1e} at 0.4 of the critical step, {:.1e} at 0.1",
                               fine.balance.injected, coarse.largest_error, fine.largest_error));
}

/// A block under the load. A load that refuses the usual block may act on cuts: it gets a block of
/// base springs alone that is cut in two.
std::unique_ptr<Plan> loaded_block(const Trial& trial) {
  Json lattice = trial.scenes.grid_box(6, 5, 7);
  try {
    return trial.scenes.plan_of({lattice, trial.scenes.material(usual_membrane), trial.example});
  } catch (const InputError&) {
    lattice["cuts"] = {{{"plane", {{"point", {0, 0, 4e-3}}, {"normal", {0, 0, 1}}}}}};
    try {
      return trial.scenes.plan_of({lattice, trial.scenes.material("none"), trial.example});
    } catch (const InputError&) {
    }
    throw;
  }
}

}  // namespace

void check_load(Trial& trial) {
  const auto plan = loaded_block(trial);
  const Model& model = *plan->model;
  trial.check("factor", [&] { return factor(model); });
  trial.check("work accounting", [&] { return work(model); });
  trial.check("same bits", [&] {
    const MotionResult one = run_motion(model, {0.5, 0.4, 40, 1}),
                       three = run_motion(model, {0.5, 0.4, 40, 3});
    return passes_if(one.is_finite() && one.hash == three.hash, "with 1 and 3 threads");
  });
  trial.check("restart", [&] {
    const MotionResult whole = run_motion(model, {0.5}),
                       cut_off = run_motion(model, {.speed = 0.5, .cut_off = true});
    return passes_if(whole.is_finite() && cut_off.hash == whole.hash &&
                         cut_off.balance.injected == whole.balance.injected,
                     "the same motion and work when it is cut off half-way and goes on");
  });
}

}  // namespace hyperlattice::contract
