// The story of a run: its folder is prepared, its stages are solved, its summary is written.
#include <base/descriptor.hpp>
#include <plan/shortage.hpp>
#include <process/lack_of_memory.hpp>
#include <run/interrupt.hpp>
#include <run/observer.hpp>
#include <run/run.hpp>
#include <run/stage_sequence.hpp>
#include <scene/json.hpp>

#include <hyperlattice/files.hpp>

#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <new>

namespace hyperlattice {

namespace {

using WallClock = std::chrono::steady_clock;

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

/// Tells what is about to run.
void announce(const Plan& plan, const RunOptions& options) {
  std::string body;
  for (const auto& [name, value] : body_lines(plan.body))
    body += fmt::format("{}{} {}", body.empty() ? "" : ", ", name, value);
  spdlog::info("the body: {}", body);
  for (const std::string& warning : plan.model->warnings) spdlog::warn("warning: {}", warning);
  const std::filesystem::path report = options.directory / "report.html";
  if (std::error_code unreadable; std::filesystem::exists(report, unreadable))
    spdlog::warn(
        "warning: {} shows an earlier state: make it anew by `hyperlattice report` after this run",
        report.string());
}

/// Does a part of the run. Errors go to the outcome.
void attempt(const Plan& plan, Outcome& outcome, const std::function<void()>& work) {
  const auto end_for_memory = [&] {
    outcome.end("failed", exit_outside,
                fmt::format("this run needs about {:.0f} MB; {}", plan.memory_bytes / 1e6,
                            lack_of_memory()));
  };
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
}

/// Returns whether a run that was asked to stop may have left out steps. The number of steps of a
/// search for rest is not known in advance.
bool may_be_short(const Plan& plan, std::uint64_t steps) {
  return steps < plan.steps() ||
         std::any_of(plan.stages.begin(), plan.stages.end(),
                     [](const PlannedStage& stage) { return stage.plan.at_rest; });
}

/// Solves the plan. `simulation`: null if it is not built yet. Errors go to the outcome.
void solve(const Plan& plan, const RunOptions& options, RunFolder& folder,
           const std::optional<Checkpoint>& resumed, std::unique_ptr<Simulation> simulation,
           Outcome& outcome) {
  std::optional<StageSequence> stages;
  attempt(plan, outcome, [&] {
    const auto start = WallClock::now();
    if (!resumed) folder.write("scene.resolved.json", plan.scene->resolved_in(options.directory));
    if (!simulation) simulation = std::make_unique<Simulation>(*plan.model, plan.threads);
    stages.emplace(plan, options, folder, *simulation);
    stages->begin(resumed);
    outcome.setup_seconds += seconds_since(start);
    if (options.observer != nullptr) options.observer->begin(*simulation);
    stages->solve();
    stages->finish();
    folder.check_tables();
    if (must_stop(options) && may_be_short(plan, simulation->steps()))
      outcome.end("interrupted", exit_interrupted, "asked to stop by a signal");
  });
  if (stages) {
    attempt(plan, outcome, [&] { stages->drain(); });  // a run that fails keeps its frames
    attempt(plan, outcome, [&] { stages->note(outcome); });
  }
  if (options.observer != nullptr && simulation) options.observer->keep(std::move(simulation));
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
    spdlog::info("done: {} step{} in {:.3g} s, results in {}", outcome.steps,
                 outcome.steps == 1 ? "" : "s", outcome.solve_seconds, directory.string());
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
  const auto start = WallClock::now();
  std::unique_ptr<Simulation> simulation;
  const std::optional<Checkpoint> resumed = prepare(folder, plan, options, simulation);
  Outcome outcome;
  outcome.setup_seconds = plan.setup_seconds + seconds_since(start);
  announce(plan, options);
  solve(plan, options, folder, resumed, std::move(simulation), outcome);
  if (outcome.exit_code == exit_interrupted)
    forget_stop();  // a request after the end is for the next run of a study
  conclude(plan, folder, outcome);
  return outcome.exit_code;
}

}  // namespace hyperlattice
