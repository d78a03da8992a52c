// The run: planned solver stages in order. Solvers make the steps; this file has the records,
// outputs, guards and the end of the run.
#include <base/descriptor.hpp>
#include <engine/guard.hpp>
#include <engine/stage_calls.hpp>
#include <plan/precision.hpp>
#include <plan/shortage.hpp>
#include <process/lack_of_memory.hpp>
#include <run/checkpoint.hpp>
#include <run/failing_motion.hpp>
#include <run/folder.hpp>
#include <run/interrupt.hpp>
#include <run/outputs.hpp>
#include <run/progress.hpp>
#include <run/run.hpp>
#include <run/summary.hpp>
#include <scene/json.hpp>
#include <state/inside_out.hpp>

#include <hyperlattice/files.hpp>

#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <new>

namespace hyperlattice {

namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class Running {
 public:
  /// `simulation`: null if it is not built yet.
  Running(Plan& plan, const RunOptions& options, RunFolder& folder,
          std::unique_ptr<Simulation> simulation)
      : plan_(plan), options_(options), folder_(folder), simulation_(std::move(simulation)) {}

  /// Starts a new run, or continues from the checkpoint `resumed`.
  void start(Outcome& outcome, const std::optional<Checkpoint>& resumed);
  void solve();
  void finish();
  std::uint64_t steps() const { return simulation_->steps(); }
  /// Writes the state of the run into the outcome, at any time.
  void note(Outcome& outcome);

 private:
  /// Steps between checks. A check reads the velocities once, a fraction of a step's work.
  static constexpr std::uint64_t guard_every = 50;

  void open(Archive* resumed);
  void visit(Archive& archive);
  void save();
  void save_if_due();
  void solve_stage(const PlannedStage& stage);
  void stepped(double time_step);
  void observe();
  void record();
  void look_at_cells();
  template <class Output>
  void timed(Output&& output);
  void clock();

  Plan& plan_;
  const RunOptions& options_;
  RunFolder& folder_;
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<Guard> guard_;
  std::unique_ptr<CellWatch> cells_;
  std::unique_ptr<History> history_;
  std::unique_ptr<FailureLog> failures_;
  std::unique_ptr<Outputs> outputs_;
  std::unique_ptr<Progress> progress_;

  const PlannedStage* stage_ = nullptr;
  /// Completed stages, and steps of the present stage.
  std::uint64_t stages_done_ = 0, stage_steps_ = 0;
  std::uint64_t observed_ = 0;  ///< number of steps at the last observation
  bool resumed_ = false;        ///< the run continues in the middle of a stage
  Clock::time_point saved_ = Clock::now();
  std::optional<RestReport> rest_;  ///< latest report of a solver
  Schedule record_schedule_;
  double time_step_ = 0;
  Record last_;
  bool recorded_ = false;
  double largest_relative_error_ = 0;
  double solve_seconds_ = 0, output_seconds_ = 0;  ///< of all parts of the run
  Clock::time_point clocked_;                      ///< end of the time in solve_seconds_
  double output_then_ = 0;                         ///< output_seconds_ at that time
};

template <class Output>
void Running::timed(Output&& output) {
  const auto start = Clock::now();
  output();
  output_seconds_ += seconds_since(start);
}

/// Adds the solver's time since the last call to solve_seconds_.
void Running::clock() {
  const auto now = Clock::now();
  solve_seconds_ +=
      std::chrono::duration<double>(now - clocked_).count() - (output_seconds_ - output_then_);
  clocked_ = now;
  output_then_ = output_seconds_;
}

void Running::start(Outcome& outcome, const std::optional<Checkpoint>& resumed) {
  const auto start = Clock::now();
  if (!resumed) folder_.write("scene.resolved.json", plan_.scene->resolved_in(options_.directory));
  if (!simulation_) simulation_ = std::make_unique<Simulation>(*plan_.model, plan_.threads);
  guard_ = std::make_unique<Guard>(*plan_.model, *simulation_);
  cells_ = std::make_unique<CellWatch>(*plan_.model);
  if (resumed)
    read_checkpoint(*resumed, [this](Archive& archive) { visit(archive); });
  else
    open(nullptr);
  progress_ = std::make_unique<Progress>(plan_.steps(), options_.quiet);
  outcome.setup_seconds += seconds_since(start);
}

/// Begins the files that grow, or continues them.
void Running::open(Archive* resumed) {
  history_ = std::make_unique<History>(folder_);
  if (plan_.model->choice.breakable) failures_ = std::make_unique<FailureLog>(folder_, resumed);
  outputs_ =
      std::make_unique<Outputs>(*plan_.model, *simulation_, folder_, plan_.end_time(), resumed);
}

/// Saves or restores all that the run needs to continue.
void Running::visit(Archive& archive) {
  simulation_->archive(archive);
  archive(stages_done_);
  archive(stage_steps_);
  archive(record_schedule_);
  archive(time_step_);
  archive(last_);
  archive(recorded_);
  archive(largest_relative_error_);
  archive(rest_);
  archive(cells_->seen());
  archive(solve_seconds_);
  archive(output_seconds_);
  if (archive.restores()) {
    resumed_ = stage_steps_ > 0;
    observed_ = simulation_->steps();
    open(&archive);
    return;
  }
  if (failures_) failures_->save(archive);
  outputs_->save(archive);
}

void Running::save() {
  clock();  // a run that continues from here counts this part too
  timed([&] {
    CheckpointHead head = checkpoint_head(plan_, simulation_->steps() == 0);
    if (!head.at_start)
      // The data that the checkpoint relies on must be on the disk before it.
      head.tables = folder_.sync();
    write_checkpoint(folder_.directory(), head, [this](Archive& archive) { visit(archive); });
  });
  saved_ = Clock::now();
}

void Running::save_if_due() {
  constexpr std::uint64_t every = 16;  // steps; a clock costs about as much as a hundred particles
  if (!stage_->plan.resumes || !(options_.checkpoint_every > 0) || stage_steps_ == 0 ||
      stage_steps_ % every != 0)
    return;
  if (seconds_since(saved_) >= options_.checkpoint_every) save();
}

void Running::solve() {
  clocked_ = Clock::now();
  output_then_ = output_seconds_;
  while (stages_done_ < plan_.stages.size()) {
    const PlannedStage& stage = plan_.stages[stages_done_];
    if (stop_requested()) return save();
    try {
      solve_stage(stage);
    } catch (...) {
      clock();
      throw;
    }
    clock();
    if (stop_requested()) return;
    ++stages_done_;
    stage_steps_ = 0;
  }
}

void Running::solve_stage(const PlannedStage& stage) {
  stage_ = &stage;
  guard_->start(stage);
  if (!resumed_) {
    record_schedule_ = Schedule(stage.start_time, record_interval(stage), true);
    time_step_ = stage.plan.time_step;
    if (!stage.plan.resumes) save();  // after an interruption the whole stage is repeated
  }
  resumed_ = false;
  StageCalls::Hooks hooks;
  hooks.stepped = [this](double time_step) { stepped(time_step); };
  hooks.observe = [this] { observe(); };
  hooks.report = [this](const RestReport& report) { rest_ = report; };
  hooks.failing_motion = [this](const std::vector<double>& motion,
                                const std::vector<double>& heights) {
    folder_.claim(failing_motion_file, false);
    write_failing_motion(options_.directory, plan_.model->body, motion, heights);
    spdlog::info("how the body moves is in {}",
                 (options_.directory / failing_motion_file).string());
  };
  hooks.must_stop = [] { return stop_requested(); };
  StageCalls(*plan_.model, *simulation_, stage, plan_.threads, std::move(hooks), stage_steps_)
      .run();
  // Such a stage has no state to save between its start and its end: it is repeated from its start.
  if (stop_requested() && !stage.plan.resumes) return;
  if (stop_requested()) {
    if (observed_ != simulation_->steps()) observe();
    save();
  }
  record();
  if (stage.plan.at_rest) {
    look_at_cells();
    timed([&] { outputs_->show_now(); });  // at rest all outputs are due
    simulation_->reset_energy_balance();
  }
}

void Running::stepped(double time_step) {
  time_step_ = time_step;
  ++stage_steps_;
  if (simulation_->steps() % guard_every == 0) guard_->check_motion(time_step);
}

void Running::observe() {
  observed_ = simulation_->steps();
  if (stage_->plan.at_rest ? simulation_->steps() % record_steps(*stage_) == 0
                           : record_schedule_.due(simulation_->time(), time_step_))
    record();
  // In a static stage times are rarely round numbers: the times of outputs have a tolerance.
  const double near_enough = 1e-6 * (stage_->plan.end_time - stage_->start_time);
  timed([&] { outputs_->show(stage_->plan.at_rest ? near_enough : time_step_); });
  progress_->update(simulation_->steps(), simulation_->time(), time_step_,
                    simulation_->breakages().size(),
                    stage_->plan.at_rest && rest_ ? rest_->residual : -1);
  save_if_due();
}

void Running::record() {
  if (recorded_ && last_.step == simulation_->steps()) return;
  const std::uint64_t open = simulation_->broken_open();
  const Record record{simulation_->time(), simulation_->steps(), simulation_->balance(), open,
                      simulation_->breakages().size() - open};
  if (record.step > 0) guard_->check_motion(time_step_);
  guard_->check_finite(record.balance, time_step_);
  last_ = record;
  recorded_ = true;
  largest_relative_error_ =
      std::max(largest_relative_error_, std::abs(record.balance.relative_error()));
  if (cells_->is_due(record.step)) look_at_cells();
  timed([&] {
    history_->write(record);
    if (failures_) failures_->write_new(simulation_->breakages());
  });
  if (!stage_->plan.at_rest) guard_->check_balance(record.balance, time_step_);
}

void Running::look_at_cells() {
  timed([&] {
    if (cells_->look(*simulation_)) spdlog::warn("{}", cells_->sentence());
  });
}

void Running::finish() {
  progress_.reset();
  look_at_cells();
  timed([&] {
    outputs_->show_last();
    outputs_->end();
  });
}

void Running::note(Outcome& outcome) {
  outcome.solve_seconds = solve_seconds_;
  outcome.output_seconds = output_seconds_;
  outcome.last = last_;
  outcome.largest_relative_error = largest_relative_error_;
  if (!simulation_) return;
  outcome.rest = rest_;
  outcome.steps = simulation_->steps();
  outcome.time = simulation_->time();
  outcome.injected_by_load = simulation_->injected_by_load();
  outcome.state_hash = simulation_->hash();
  if (outcome.exit_code == exit_run) look_at_cells();  // folded cells may be the reason
  if (std::string sentence = cells_ ? cells_->sentence() : ""; !sentence.empty())
    outcome.warnings.push_back(std::move(sentence));
  if (plan_.model->choice.precision == Precision::doubles) return;
  if (std::string warning = precision_warning(*plan_.model, simulation_->farthest());
      !warning.empty())
    outcome.warnings.push_back(std::move(warning));
}

/// Takes the memory and threads of a run before it removes the results of an earlier run. Throws
/// OutsideError if the system refuses them; but returns null if there are no results to lose: the
/// run then fails by itself and leaves a summary.
std::unique_ptr<Simulation> build(const RunFolder& folder, const Plan& plan) {
  try {
    return std::make_unique<Simulation>(*plan.model, plan.threads);
  } catch (const std::bad_alloc&) {
    if (folder.has_results())
      throw OutsideError(fmt::format("nothing was changed: this run needs about {:.0f} MB; {}",
                                     plan.memory_bytes / 1e6, lack_of_memory()));
  } catch (const OutsideError& error) {
    if (folder.has_results())
      throw OutsideError(fmt::format("nothing was changed: {}", error.what()));
  }
  return nullptr;
}

/// Returns all files that the run depends on.
std::vector<std::filesystem::path> inputs_of(const Plan& plan) {
  std::vector<std::filesystem::path> inputs{plan.scene->file};
  for (const Dependence& one : plan.identity)
    if (!one.path.empty()) inputs.push_back(one.path);
  return inputs;
}

/// Prepares the folder. Returns the checkpoint from which the run continues, or nothing for a new
/// run.
std::optional<Checkpoint> prepare(RunFolder& folder, Plan& plan, const RunOptions& options,
                                  std::unique_ptr<Simulation>& simulation) {
  std::optional<Checkpoint> resumed;
  if (options.resume) resumed = find_checkpoint(plan, options.directory);
  if (resumed && resumed->head.threads != plan.threads) {
    spdlog::info("the run goes on with {} threads, as it began", resumed->head.threads);
    set_threads(plan, resumed->head.threads);
  }
  simulation = build(folder, plan);
  if (resumed && !resumed->head.at_start)
    folder.go_on(resumed->head.tables, output_names(plan));
  else
    folder.begin(options.overwrite || resumed, output_names(plan), inputs_of(plan));
  if (resumed && resumed->head.at_start) resumed.reset();
  return resumed;
}

/// Solves the plan. Errors go to the outcome.
void carry_out(Plan& plan, const RunOptions& options, RunFolder& folder,
               const std::optional<Checkpoint>& resumed, std::unique_ptr<Simulation> simulation,
               Outcome& outcome) {
  Running running(plan, options, folder, std::move(simulation));
  const auto end_for_memory = [&] {
    outcome.end("failed", exit_outside,
                fmt::format("this run needs about {:.0f} MB; {}", plan.memory_bytes / 1e6,
                            lack_of_memory()));
  };
  const auto attempt = [&](const std::function<void()>& work) {
    try {
      work();
    } catch (const RunError& error) {
      if (memory_ran_out()) end_for_memory();  // also the reason if a plugin failed
      outcome.end("failed", exit_run, error.what());
    } catch (const std::bad_alloc&) {
      end_for_memory();
    } catch (const std::exception& error) {
      outcome.end("failed", exit_outside, error.what());
    }
  };
  attempt([&] {
    running.start(outcome, resumed);
    running.solve();
    running.finish();
    folder.check_tables();
    // The number of steps of a search for rest is not known in advance.
    const bool short_of = running.steps() < plan.steps() ||
                          std::any_of(plan.stages.begin(), plan.stages.end(),
                                      [](const PlannedStage& stage) { return stage.plan.at_rest; });
    if (stop_requested() && short_of)
      outcome.end("interrupted", exit_interrupted, "asked to stop by a signal");
  });
  attempt([&] { running.note(outcome); });
}

/// Finishes the folder after the summary, which stays true if an error occurs here.
void tidy_up(RunFolder& folder, const Outcome& outcome, bool has_checkpoint) {
  try {
    folder.finish();
    if (has_checkpoint) sync_directory(folder.directory());
    if (outcome.exit_code == exit_done || (outcome.exit_code == exit_run && !has_checkpoint))
      remove_checkpoints(folder.directory());
  } catch (const std::exception& error) {
    spdlog::warn("warning: after the end of the run: {}", error.what());
  }
}

/// Writes the summary. The checkpoint is removed when the run is done and the summary is on the
/// disk; a failed run keeps its checkpoint.
void conclude(const Plan& plan, RunFolder& folder, Outcome& outcome) {
  const std::filesystem::path& directory = folder.directory();
  const bool has_checkpoint = holds_progress(directory);
  try {
    if (outcome.exit_code == exit_done && has_checkpoint) folder.sync();
    try {
      folder.claim("summary.json", true);
    } catch (const OutsideError& error) {  // on a full disk there may be room for the summary yet
      spdlog::error("{}", error.what());
    }
    AtomicFile summary((directory / "summary.json").string());
    summary.write(json_text(summary_json(plan, outcome)));
    if (has_checkpoint) summary.sync();
    summary.commit();
    tidy_up(folder, outcome, has_checkpoint);
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    if (outcome.exit_code == exit_done) outcome.end("failed", exit_outside, error.what());
  }
  if (outcome.exit_code == exit_done)
    spdlog::info("done: {} steps in {:.3g} s, results in {}", outcome.steps, outcome.solve_seconds,
                 directory.string());
  else
    spdlog::error("{}: {}", outcome.status, outcome.reason);
  if (outcome.exit_code != exit_done && has_checkpoint)
    spdlog::info("a checkpoint is in {}: --resume goes on from it, --overwrite gives it up",
                 directory.string());
}

}  // namespace

int run(Plan& plan, const RunOptions& options) {
  refuse_shortage(plan, options.directory);
  if (options.resume) must_be_resumable(options.directory);
  RunFolder folder(options.directory, !options.resume);
  const auto start = Clock::now();
  std::unique_ptr<Simulation> simulation;
  const std::optional<Checkpoint> resumed = prepare(folder, plan, options, simulation);
  Outcome outcome;
  outcome.setup_seconds = plan.setup_seconds + seconds_since(start);
  std::string body;
  for (const auto& [name, value] : body_lines(plan.body))
    body += fmt::format("{}{} {}", body.empty() ? "" : ", ", name, value);
  spdlog::info("the body: {}", body);
  for (const std::string& warning : plan.model->warnings) spdlog::warn("warning: {}", warning);
  if (std::error_code unreadable;
      std::filesystem::exists(options.directory / "report.html", unreadable))
    spdlog::warn(
        "warning: {} shows an earlier state: make it anew by `hyperlattice report` after this run",
        (options.directory / "report.html").string());
  carry_out(plan, options, folder, resumed, std::move(simulation), outcome);
  if (outcome.exit_code == exit_interrupted)
    forget_stop();  // a request after the end is for the next run of a study
  conclude(plan, folder, outcome);
  return outcome.exit_code;
}

}  // namespace hyperlattice
