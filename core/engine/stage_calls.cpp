#include <base/errors.hpp>
#include <engine/stage_calls.hpp>
#include <plan/solver_facts.hpp>
#include <scene/stage_call.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

template <class Code>
bool StageCalls::guarded(Code&& code) noexcept {
  return PluginCall::answer(false, [&] {
    code();
    return !hooks_.must_stop || !hooks_.must_stop();
  });
}

Statics& StageCalls::statics(Statics::Search search) {
  if (!statics_) {
    statics_ = std::make_unique<Statics>(model_, simulation_, search, stage_.start_time,
                                         stage_.plan.end_time, threads_);
    if (!resumed_.statics.empty()) statics_->recall(resumed_.statics);
  }
  if (statics_->problem().grid.inertia != (search == Statics::Search::motion))
    throw PluginMistake("it searches states of rest and steps in time in one stage");
  return *statics_;
}

StageCalls::StageCalls(const Model& model, Simulation& simulation, const PlannedStage& stage,
                       int threads, Hooks hooks, std::uint64_t steps_done, StageMemory memory)
    : model_(model),
      simulation_(simulation),
      stage_(stage),
      threads_(threads),
      hooks_(std::move(hooks)),
      resumed_(std::move(memory)),
      kept_(resumed_.solver) {
  host_.self = this;
  host_.time = simulation.time();
  host_.steps_done = steps_done;
  host_.kept = resumed_.solver;
  host_.take_step = [](void* self, double time_step) noexcept {
    auto& calls = *static_cast<StageCalls*>(self);
    return calls.guarded([&] {
      if (!(time_step > 0 && std::isfinite(time_step)))
        throw PluginMistake(fmt::format("it takes a step of {} s", time_step));
      calls.simulation_.step(time_step);
      calls.meet_end(time_step);
      calls.host_.time = calls.simulation_.time();
      if (calls.hooks_.stepped) calls.hooks_.stepped(time_step);
      if (calls.hooks_.advanced) calls.hooks_.advanced(true);
    });
  };
  host_.show = [](void* self) noexcept {
    auto& calls = *static_cast<StageCalls*>(self);
    return calls.guarded([&] {
      if (calls.hooks_.observe) calls.hooks_.observe();
    });
  };
  host_.open = [](void* self) noexcept -> const StaticProblem* {
    auto& calls = *static_cast<StageCalls*>(self);
    return calls.guarded([&] { calls.statics(); }) ? &calls.statics_->problem() : nullptr;
  };
  host_.open_motion = [](void* self) noexcept -> const StaticProblem* {
    auto& calls = *static_cast<StageCalls*>(self);
    return calls.guarded([&] { calls.statics(Statics::Search::motion); })
               ? &calls.statics_->problem()
               : nullptr;
  };
  host_.take_motion = [](void* self, const double* mean) noexcept {
    auto& calls = *static_cast<StageCalls*>(self);
    return calls.guarded([&] {
      const double before = calls.simulation_.time();
      calls.statics(Statics::Search::motion).accept_step(mean);
      const double length = calls.simulation_.time() - before;
      calls.meet_end(length);
      calls.host_.time = calls.simulation_.time();
      if (calls.hooks_.stepped) calls.hooks_.stepped(length);
      if (calls.hooks_.advanced) calls.hooks_.advanced(false);
    });
  };
  host_.take = [](void* self, double fraction, const double* displacement) noexcept {
    auto& calls = *static_cast<StageCalls*>(self);
    return calls.guarded([&] {
      calls.statics().accept(fraction, displacement);
      calls.host_.time = calls.simulation_.time();
      if (calls.hooks_.rested) calls.hooks_.rested();
      if (calls.hooks_.advanced) calls.hooks_.advanced(false);
    });
  };
  host_.measure_rest = [](void* self, RestReport* report, double* kinetic) noexcept {
    auto& calls = *static_cast<StageCalls*>(self);
    return calls.guarded([&] {
      if (report != nullptr) {
        const RestReport now = calls.statics().rest();
        report->residual = now.residual;
        report->displacement_error = now.displacement_error;
      }
      if (kinetic != nullptr) *kinetic = calls.simulation_.kinetic();
    });
  };
  host_.stop_motion = [](void* self) noexcept {
    auto& calls = *static_cast<StageCalls*>(self);
    return calls.guarded([&] { calls.simulation_.halt(); });
  };
  host_.set_damping_rate = [](void* self, double rate) noexcept {
    auto& calls = *static_cast<StageCalls*>(self);
    calls.guarded([&] {
      if (!(rate >= 0 && std::isfinite(rate)))
        throw PluginMistake(fmt::format("it damps at a rate of {} 1/s", rate));
      calls.simulation_.set_damping(calls.stage_.plan.damping, rate);
    });
  };
  host_.keep_numbers = [](void* self, const double* numbers, std::size_t count) noexcept {
    PluginCall::answer(
        [&] { static_cast<StageCalls*>(self)->kept_.assign(numbers, numbers + count); });
  };
  host_.show_rest = [](void* self, const RestReport& report) noexcept {
    auto& calls = *static_cast<StageCalls*>(self);
    return calls.guarded([&] {
      if (calls.hooks_.report) calls.hooks_.report(report);
    });
  };
  host_.keep_motion = [](void* self, const double* motion) noexcept {
    auto& calls = *static_cast<StageCalls*>(self);
    return calls.guarded([&] {
      if (!calls.hooks_.failing_motion) return;
      const Statics& statics = calls.statics();
      const bool has_heights = statics.problem().grid.components == 4;
      calls.hooks_.failing_motion(
          statics.of_particles(motion, 0, 3),
          has_heights ? statics.of_particles(motion, 3, 1) : std::vector<double>());
    });
  };
}

/// Sets the time to the stage's end if the sum of equal steps differs from it only by round-off.
void StageCalls::meet_end(double time_step) {
  constexpr double nearby = 1e-3;  // of a step
  const double end = stage_.plan.end_time;
  if (std::abs(simulation_.time() - end) < nearby * time_step) simulation_.set_time(end);
}

void StageCalls::run() {
  const Stage& stage = *stage_.stage;
  simulation_.set_added_mass(stage_.mass_scaling ? stage_.mass_scaling->time_step() : 0);
  // A run that is resumed has the damping of its last step, with which that state is recorded.
  if (host_.steps_done == 0) simulation_.set_damping(stage_.plan.damping);
  simulation_.set_local_steps(stage_.plan.local.time_step, stage_.plan.local.parts);
  if (stage_.plan.at_rest && stage_.plan.time_step > 0)
    simulation_.hold_time(stage_.plan.end_time);  // otherwise the solver sets the time
  SolverFacts facts = solver_facts(model_, stage_.start_time);
  if (stage_.mass_scaling)
    facts.critical_time_step = std::max(facts.critical_time_step, stage_.mass_scaling->time_step());
  const auto failed = refusal_of(stage, "run", [&](const Complaint& why) {
    const bool done =
        stage.functions<SolverFunctions>().run(stage_.component.get(), facts, host_, why);
    simulation_.release_time();
    return done;
  });
  if (failed)
    throw RunError(
        fmt::format("{} ({}) failed: {}", stage.component->type(), stage.pointer, *failed));
}

StageMemory StageCalls::memory() const {
  return {kept_, statics_ ? statics_->memory() : resumed_.statics};
}

RestReport bring_to_rest(const Plan& plan, Simulation& simulation) {
  RestReport last;
  StageCalls::Hooks hooks;
  hooks.report = [&](const RestReport& report) { last = report; };
  StageCalls(*plan.model, simulation, plan.stages.front(), plan.threads, std::move(hooks)).run();
  return last;
}

}  // namespace hyperlattice
