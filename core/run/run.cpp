// The story of a run: its folder is prepared, its stages are solved, its summary is written.
#include <base/descriptor.hpp>
#include <plan/shortage.hpp>
#include <process/lack_of_memory.hpp>
#include <run/final_state.hpp>
#include <run/interrupt.hpp>
#include <run/observer.hpp>
#include <run/run.hpp>
#include <run/stage_sequence.hpp>
#include <scene/json.hpp>

#include <hyperlattice/files.hpp>

#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <new>

namespace hyperlattice {

namespace {

using WallClock = std::chrono::steady_clock;

/// Takes the memory and threads of a run before it removes the results of an earlier run. Throws
/// OutsideError if the system refuses them; but returns null if there are no results to lose: the
/// run then fails by itself and leaves a summary.
std::unique_ptr<Simulation> build(const RunFolder& folder, const Plan& plan, Ranks& ranks) {
  try {
    return std::make_unique<Simulation>(*plan.model, plan.threads, ranks, plan.blocks);
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

/// Builds the simulation, and prepares the folder for a new run or for one that goes on from
/// `resumed`, which is cleared if it holds no step.
void prepare(RunFolder& folder, Plan& plan, const RunOptions& options, Ranks& ranks,
             std::optional<Checkpoint>& resumed, std::unique_ptr<Simulation>& simulation) {
  const std::int32_t blocks = resumed      ? resumed->head.blocks
                              : plan.start ? plan.start->blocks
                                           : plan.blocks;
  if (blocks != plan.blocks) {
    set_blocks(plan, blocks);
    spdlog::info("the run goes on with {} threads{}, as it began", plan.threads,
                 plan.ranks == 1 ? "" : " in each rank");
  }
  simulation = build(folder, plan, ranks);
  const bool goes_on = resumed && !resumed->head.at_start;
  if (ranks.is_first() && goes_on)
    folder.go_on(resumed->head.tables, output_names(plan));
  else if (ranks.is_first())
    folder.begin(options.overwrite || resumed, output_names(plan), inputs_of(plan));
  if (!goes_on) resumed.reset();
}

/// Throws OutsideError in a rank whose program, plugins, instruction set or files differ from those
/// of the first one.
void must_be_alike(const Plan& plan, Ranks& ranks) {
  if (ranks.is_alone()) return;
  ranks.meet(Ranks::Meeting::start);
  std::string text = identity_json(plan.identity).dump();
  std::array<std::int64_t, 1> size{static_cast<std::int64_t>(text.size())};
  ranks.spread(0, std::as_writable_bytes(std::span(size)));
  text.resize(static_cast<std::size_t>(size[0]));
  ranks.spread(0, std::as_writable_bytes(std::span(text)));
  if (ranks.is_first()) return;
  if (const std::string differs =
          changes(read_identity(nlohmann::json::parse(text)), plan.identity);
      !differs.empty())
    throw OutsideError("this rank must do the same as rank 0, but " + differs);
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
void attempt(const Plan& plan, Ranks& ranks, Outcome& outcome, const std::function<void()>& work) {
  const auto end_for_memory = [&] {
    outcome.end("failed", exit_outside,
                fmt::format("this run needs about {:.0f} MB; {}", plan.memory_bytes / 1e6,
                            lack_of_memory()));
  };
  try {
    ranks.together(work);
  } catch (const OtherRankError& error) {
    outcome.end("failed", error.exit_code(), error.what());
  } catch (const RunError& error) {
    if (memory_ran_out()) end_for_memory();  // also the reason if a plugin failed
    outcome.end("failed", exit_run, error.what());
  } catch (const std::bad_alloc&) {
    end_for_memory();
  } catch (const std::exception& error) {
    outcome.end("failed", exit_outside, error.what());
  }
}

/// Returns whether a run that was asked to stop at `time`, s, may have left out steps. Their number
/// is not known in advance in a search for rest and with automatic steps, and the time of a search
/// for rest does not say how far it is.
bool may_be_short(const Plan& plan, double time) {
  return time < plan.end_time() ||
         std::any_of(plan.stages.begin(), plan.stages.end(),
                     [](const PlannedStage& stage) { return stage.plan.at_rest; });
}

/// Solves the plan. `simulation`: null if it is not built yet. Errors go to the outcome.
void solve(const Plan& plan, const RunOptions& options, RunFolder& folder,
           const std::optional<Checkpoint>& resumed, std::unique_ptr<Simulation> simulation,
           Ranks& ranks, Outcome& outcome) {
  std::optional<StageSequence> stages;
  attempt(plan, ranks, outcome, [&] {
    const auto start = WallClock::now();
    if (!resumed) folder.write("scene.resolved.json", plan.scene->resolved_in(options.directory));
    if (!simulation)
      simulation = std::make_unique<Simulation>(*plan.model, plan.threads, ranks, plan.blocks);
    stages.emplace(plan, options, folder, *simulation, ranks);
    stages->begin(resumed);
    outcome.setup_seconds += seconds_since(start);
    if (options.observer != nullptr) options.observer->begin(*simulation);
    stages->solve();
    stages->finish();
    folder.check_tables();
    if (ranks.agreed(Wish::stop) && may_be_short(plan, simulation->time()))
      outcome.end("interrupted", exit_interrupted, "asked to stop by a signal");
    else if (options.keep_state)
      write_final_state(plan, *simulation, folder, ranks);
  });
  if (stages) {
    attempt(plan, ranks, outcome, [&] { stages->drain(); });  // a run that fails keeps its frames
    attempt(plan, ranks, outcome, [&] { stages->note(outcome); });
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

/// Returns a sentence about the last state that a failed run left to go on from.
std::string about_last_state(const Plan& plan, const std::filesystem::path& directory,
                             const RunOptions& options) {
  if (const std::string place = place_of_checkpoint(directory); !place.empty())
    return fmt::format(
        "The newest checkpoint is of {}: --resume goes on from it, --overwrite gives it up.",
        place);
  if (options.checkpoint_every > 0)
    return fmt::format(
        "There is no checkpoint: the run failed within {:.3g} s; fewer seconds of "
        "--checkpoint-every leave one.",
        Checkpoints::first_interval(plan, options.checkpoint_every));
  return "There is no checkpoint: --checkpoint-every SECONDS asks for some.";
}

/// Writes the summary. The checkpoint is removed when the run is done and the summary is on the
/// disk; a failed run keeps its checkpoint.
void conclude(const Plan& plan, const RunOptions& options, RunFolder& folder, Outcome& outcome) {
  const std::filesystem::path& directory = folder.directory();
  const bool has_checkpoint = holds_progress(directory);
  if (outcome.exit_code == exit_run)
    outcome.reason +=
        (outcome.reason.ends_with('.') ? " " : ". ") + about_last_state(plan, directory, options);
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
  if (outcome.exit_code != exit_done && outcome.exit_code != exit_run && has_checkpoint)
    spdlog::info("a checkpoint is in {}: --resume goes on from it, --overwrite gives it up",
                 directory.string());
}

}  // namespace

int run(Plan& plan, const RunOptions& options) {
  plan.alone = std::make_unique<Ranks>();
  return run(plan, options, *plan.alone);
}

int run(Plan& plan, const RunOptions& options, Ranks& ranks) {
  const auto start = WallClock::now();
  std::optional<RunFolder> folder;
  std::optional<Checkpoint> resumed;
  ranks.together([&] { must_be_alike(plan, ranks); });
  // All ranks read the checkpoint's head before the first one changes the folder.
  ranks.together([&] {
    refuse_shortage(plan, options.directory);
    if (options.resume) must_be_resumable(options.directory);
    if (ranks.is_first())
      folder.emplace(options.directory, !options.resume);
    else
      folder.emplace(options.directory);
    if (options.resume) resumed = find_checkpoint(plan, options.directory);
  });
  std::unique_ptr<Simulation> simulation;
  ranks.together([&] { prepare(*folder, plan, options, ranks, resumed, simulation); });
  Outcome outcome;
  outcome.setup_seconds = plan.setup_seconds + seconds_since(start);
  announce(plan, options);
  solve(plan, options, *folder, resumed, std::move(simulation), ranks, outcome);
  if (outcome.exit_code == exit_interrupted)
    forget_stop();  // a request after the end is for the next run of a study
  if (ranks.is_first()) conclude(plan, options, *folder, outcome);
  return outcome.exit_code;
}

}  // namespace hyperlattice
