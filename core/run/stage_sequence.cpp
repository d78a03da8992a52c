#include <base/errors.hpp>
#include <plan/precision.hpp>
#include <process/peak_memory.hpp>
#include <run/failing_motion.hpp>
#include <run/final_state.hpp>
#include <run/interrupt.hpp>
#include <run/observer.hpp>
#include <run/stage_sequence.hpp>

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <memory>
#include <utility>

namespace hyperlattice {

StageSequence::StageSequence(const Plan& plan, const RunOptions& options, RunFolder& folder,
                             Simulation& simulation, Ranks& ranks)
    : plan_(plan),
      options_(options),
      folder_(folder),
      simulation_(simulation),
      ranks_(ranks),
      recorder_(plan, simulation, folder, stopwatch_, ranks),
      checkpoints_(
          plan, folder, stopwatch_, ranks, options.checkpoint_every,
          [this] { return recorder_.is_sound(); },
          [this] {
            recorder_.drain();
            simulation_.prepare_to_save();
          },
          [&simulation] { simulation.pass_to_first(); },
          [this](Archive& state) { archive(state); }) {}

void StageSequence::archive(Archive& archive) {
  simulation_.archive(archive);
  archive(stages_done_);
  archive(stage_steps_);
  if (!archive.restores()) memory_ = calls_ != nullptr ? calls_->memory() : StageMemory();
  archive(memory_.solver);
  archive(memory_.statics);
  if (!archive.restores()) memory_ = {};
  recorder_.archive(archive);
  if (archive.restores()) is_resumed_ = stage_steps_ > 0;
}

void StageSequence::begin(const std::optional<Checkpoint>& resumed) {
  if (resumed)
    read_checkpoint(*resumed, [this](Archive& state) { archive(state); });
  else if (plan_.start)
    start_from(*plan_.start, *plan_.model, simulation_, ranks_);
  recorder_.begin(options_.quiet || !ranks_.is_first());
}

void StageSequence::solve() {
  stopwatch_.start();
  while (stages_done_ < plan_.stages.size()) {
    ranks_.meet(Ranks::Meeting::stage);
    if (must_stop()) return checkpoints_.save(simulation_.steps(), simulation_.time());
    try {
      solve_stage(plan_.stages[stages_done_]);
    } catch (...) {
      stopwatch_.lap();
      throw;
    }
    stopwatch_.lap();
    if (must_stop()) return;
    ++stages_done_;
    stage_steps_ = 0;
  }
}

/// Returns whether all ranks have agreed to stop.
bool StageSequence::must_stop() {
  if (hyperlattice::must_stop(options_)) ranks_.wish(Wish::stop);
  return ranks_.agreed(Wish::stop);
}

void StageSequence::solve_stage(const PlannedStage& stage) {
  const bool resumes = stage.plan.resumes;  // otherwise the stage is repeated from its start
  recorder_.start_stage(stage, is_resumed_);
  if (!is_resumed_ && (!resumes || stage.plan.at_rest))
    checkpoints_.save(simulation_.steps(), simulation_.time());
  is_resumed_ = false;
  StageCalls::Hooks hooks;
  hooks.stepped = [this](double time_step) {
    ++stage_steps_;
    recorder_.take_step(time_step);
  };
  hooks.rested = [this] { ++stage_steps_; };
  const double sweeps = stage.plan.sweeps_per_step;
  hooks.observe = [this, resumes, sweeps] {
    recorder_.observe();
    if (resumes)
      checkpoints_.save_if_due(simulation_.steps(), simulation_.time(), stage_steps_, sweeps);
  };
  hooks.report = [this](const RestReport& report) { recorder_.take_report(report); };
  hooks.failing_motion = [this](const std::vector<double>& motion,
                                const std::vector<double>& heights) {
    write_motion(motion, heights);
  };
  if (RunObserver* const observer = options_.observer; observer != nullptr)
    hooks.advanced = [this, observer](bool can_change) {
      observer->advanced(simulation_, can_change);
    };
  hooks.must_stop = [this] { return must_stop(); };
  StageCalls calls(*plan_.model, simulation_, stage, plan_.threads, std::move(hooks), stage_steps_,
                   std::exchange(memory_, {}));
  calls_ = &calls;
  const auto forget = [this](const StageCalls*) { calls_ = nullptr; };
  const std::unique_ptr<const StageCalls, decltype(forget)> present(&calls, forget);
  calls.run();
  if (must_stop()) {
    if (!resumes) return;
    // A solver that looks for rest may have stopped before a state that it shows.
    if (!stage.plan.at_rest) recorder_.observe_once();
    if (stage_steps_ > 0) checkpoints_.save(simulation_.steps(), simulation_.time());
    if (stage.plan.at_rest) return;
  }
  recorder_.end_stage();
  // A solver may end before the whole load acts; the loads of the next stage would jump.
  constexpr double nearly = 1e-9;
  const double missing = stage.plan.end_time - simulation_.time();
  if (stage.plan.at_rest && stages_done_ + 1 < plan_.stages.size() &&
      missing > nearly * std::abs(stage.plan.end_time))
    throw RunError(
        fmt::format("{} ({}) ended under the loads of {:.6g} s, and not of its end_time, {:.6g} s, "
                    "at which the next stage begins",
                    stage.stage->component->type(), stage.stage->pointer, simulation_.time(),
                    stage.plan.end_time));
  if (stage.plan.at_rest) simulation_.reset_energy_balance();
}

void StageSequence::write_motion(const std::vector<double>& motion,
                                 const std::vector<double>& heights) {
  if (!ranks_.is_first()) return;
  folder_.claim(failing_motion_file, false);
  write_failing_motion(options_.directory, plan_.model->body, motion, heights);
  spdlog::info("how the body moves is in {}", (options_.directory / failing_motion_file).string());
}

void StageSequence::note(Outcome& outcome) {
  outcome.solve_seconds = stopwatch_.solve_seconds();
  outcome.output_seconds = stopwatch_.output_seconds();
  outcome.steps = simulation_.steps() - plan_.first_step();
  outcome.time = simulation_.time();
  outcome.injected_by_load = simulation_.injected_by_load();
  outcome.state_hash = simulation_.hash();
  recorder_.note(outcome);
  outcome.peak_bytes.assign(static_cast<std::size_t>(ranks_.count()), 0);
  outcome.peak_bytes[static_cast<std::size_t>(ranks_.rank())] = peak_memory_bytes();
  ranks_.meet(Ranks::Meeting::stage);
  ranks_.sum(outcome.peak_bytes);
  if (plan_.model->springs.choice.precision == Precision::doubles) return;
  if (std::string warning = precision_warning(*plan_.model, simulation_.farthest());
      !warning.empty())
    outcome.warnings.push_back(std::move(warning));
}

}  // namespace hyperlattice
