// The contract of solvers: the time step is at most the stable one, the solver reaches its end, and
// results do not depend on the number of threads.
#include <contract/families.hpp>
#include <engine/stage_calls.hpp>

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <optional>
#include <utility>

namespace hyperlattice::contract {
namespace {

/// Returns a bar that is held at its low end and shortened from the other.
std::vector<Json> pressed_bar(const Scenes& scenes) {
  return {scenes.grid_box(4, 4, 8), scenes.material(usual_membrane), scenes.platen("z_min", 0),
          scenes.platen("z_max", -1e-6)};
}

struct SolverResult {
  double time = 0;
  double relative_error = 0;  ///< relative error of the energy balance
  std::uint64_t steps = 0, hash = 0;
  RestReport rest;
};
/// Runs the solver; with `cut_off` > 0, stops after that many steps and continues in another
/// simulation.
SolverResult solve(const Plan& plan, std::uint64_t cut_off = 0) {
  auto simulation = std::make_unique<Simulation>(*plan.model, plan.threads);
  simulation->balance();
  SolverResult solved;
  StageMemory memory;
  const auto run = [&](std::uint64_t done, std::uint64_t end) {
    StageCalls::Hooks hooks;
    hooks.report = [&](const RestReport& report) { solved.rest = report; };
    if (end > 0) hooks.must_stop = [&] { return simulation->steps() >= end; };
    StageCalls calls(*plan.model, *simulation, plan.stages.front(), plan.threads, std::move(hooks),
                     done, std::exchange(memory, {}));
    calls.run();
    memory = calls.memory();
  };
  if (cut_off > 0) {
    run(0, cut_off);
    simulation = restarted(*simulation, *plan.model, plan.threads);
  }
  run(cut_off, 0);
  solved.time = simulation->time();
  solved.relative_error = simulation->balance().relative_error();
  solved.steps = simulation->steps();
  solved.hash = simulation->hash();
  return solved;
}

Finding stable(const SolverPlan& plan) {
  if (!(plan.time_step > 0)) return not_applicable("it takes no steps in time");
  return passes_if(plan.time_step <= plan.stable_time_step,
                   fmt::format("steps of {:.4g} s, stable below {:.4g} s", plan.time_step,
                               plan.stable_time_step));
}

Finding comes_to_its_end(const SolverPlan& plan, const SolverResult& solved) {
  if (plan.at_rest) {
    const double residual = solved.rest.residual;
    return passes_if(residual >= 0 && residual < 1e-2 && solved.steps > 0,
                     fmt::format("at rest to a residual of {:.1e} of the mean force", residual));
  }
  return passes_if(
      std::abs(solved.time / plan.end_time - 1) < 1e-9 && std::abs(solved.relative_error) < 0.01,
      fmt::format("{} steps to {:.6g} s, relative error of the energy balance {:.1e}", solved.steps,
                  solved.time, solved.relative_error));
}

}  // namespace

void check_solver(Trial& trial) {
  std::vector<Json> stages = pressed_bar(trial.scenes);
  stages.push_back(trial.example);
  const auto plan = trial.scenes.plan_of(stages, 1), with_three = trial.scenes.plan_of(stages, 3);
  trial.check("stable step", [&] { return stable(plan->stages.front().plan); });
  std::optional<SolverResult> solved;
  trial.check("comes to its end", [&] {
    solved = solve(*plan);
    return comes_to_its_end(plan->stages.front().plan, *solved);
  });
  trial.check("same bits", [&] {
    return passes_if(solved && solve(*with_three).hash == solved->hash, "with 1 and 3 threads");
  });
  trial.check("restart", [&] {
    if (!plan->stages.front().plan.resumes)
      return not_applicable("a stage that is cut off begins anew");
    return passes_if(solved && solve(*plan, solved->steps / 2).hash == solved->hash,
                     "the same bits when it is cut off half-way and goes on");
  });
}

}  // namespace hyperlattice::contract
