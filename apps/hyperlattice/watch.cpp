// hyperlattice watch: plans or runs a scene again whenever it, or a file that it names, changes.
// Each round is a process of its own, so that changed plugins are opened anew and a crash ends only
// the round.
#include "child_process.hpp"
#include "commands.hpp"
#include "watched_files.hpp"

#include <base/errors.hpp>
#include <base/folder_file.hpp>
#include <plan/file_names.hpp>
#include <run/checkpoint.hpp>

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <optional>

namespace hyperlattice {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// A file in the folder of results, by which a later watch knows that the folder is one of its own.
constexpr const char* mark_of_watch = "watch.txt";
/// Editors write a file in several steps: a round begins when this time has passed without one.
constexpr auto quiet_time = 200ms;
constexpr auto longest_unrest = 3s;
/// Files are also looked at from time to time, because not all file systems tell their changes.
constexpr auto look_every = 1s;

std::string meaning_of(const ChildProcess::End& end) {
  if (end.signal != 0) return fmt::format("ended by signal {}", end.signal);
  switch (end.exit_code) {
    case exit_done:
      return "done";
    case exit_input:
      return "wrong input";
    case exit_run:
      return "the run failed";
    case exit_outside:
      return "the outside failed";
    case exit_interrupted:
      return "interrupted";
    default:
      return fmt::format("exit code {}", end.exit_code);
  }
}

std::string names_of(const std::vector<fs::path>& files) {
  constexpr std::size_t most = 3;
  std::string text;
  for (std::size_t n = 0; n < std::min(files.size(), most); ++n)
    text += (n == 0 ? "" : ", ") + files[n].filename().string();
  if (files.size() > most) text += fmt::format(" and {} more", files.size() - most);
  return text;
}

class Watch {
 public:
  /// `words`: name, options and command of each round, of which `command` is the command.
  /// `results`: the folder into which a round writes; empty: none.
  Watch(WatchedFiles files, std::string command, std::vector<std::string> words, fs::path results)
      : files_(std::move(files)),
        command_(std::move(command)),
        words_(std::move(words)),
        results_(std::move(results)) {}

  /// Repeats rounds until a signal asks to stop. Returns the exit code.
  int run() {
    std::string why = "first round";
    while (!signals_.asked_to_stop()) {
      const std::vector<fs::path> changed = do_round(why);
      if (signals_.asked_to_stop()) break;
      why = (changed.empty() ? names_of(wait_for_changes()) : names_of(changed)) + " changed";
    }
    return exit_interrupted;
  }

 private:
  /// Returns the files that changed during the round, which ended it; none if it came to its end.
  std::vector<fs::path> do_round(const std::string& why) {
    ++round_;
    const auto start = Clock::now();
    const auto tell = [&](const std::string& what) {
      spdlog::info("watch: round {} ({}), {}: {}, in {:.2f} s", round_, why, command_, what,
                   std::chrono::duration<double>(Clock::now() - start).count());
    };
    if (const std::string foreign = objection_to_folder(); !foreign.empty()) {
      tell("left out, because " + foreign);
      return {};
    }
    ChildProcess child(words_);
    std::vector<fs::path> changed;
    bool is_stopping = false;
    std::optional<ChildProcess::End> end;
    while (!(end = child.ended())) {
      const bool stirred = signals_.wait(files_.descriptor(), look_every);
      if (signals_.take_request()) {
        child.stop();  // a second request ends it at once
        is_stopping = true;
      } else if (!is_stopping && (stirred || files_.seem_changed())) {
        changed = settled_changes();
        is_stopping = !changed.empty();
        if (is_stopping) child.stop();
      }
    }
    mark_folder();
    if (!changed.empty() && end->exit_code == exit_interrupted) give_up_run();
    tell(changed.empty() ? meaning_of(*end) : "given up, because files changed");
    return changed;
  }

  std::vector<fs::path> wait_for_changes() {
    for (;;) {
      const bool stirred = signals_.wait(files_.descriptor(), look_every);
      if (signals_.asked_to_stop()) return {};
      if (!stirred && !files_.seem_changed()) continue;
      if (auto changed = settled_changes(); !changed.empty()) return changed;
    }
  }

  /// Waits until the files have been left alone for a while. Returns those whose content changed.
  std::vector<fs::path> settled_changes() {
    const auto start = Clock::now();
    do files_.forget_events();
    while (signals_.wait(files_.descriptor(), quiet_time) && Clock::now() - start < longest_unrest);
    return files_.find_changes();
  }

  /// Returns why the folder of results is not used; empty if it is free or a watch left it.
  std::string objection_to_folder() const {
    std::error_code unreadable;
    if (results_.empty() || !is_there(results_) || is_there(results_ / mark_of_watch) ||
        (fs::is_directory(results_, unreadable) && fs::is_empty(results_, unreadable)))
      return {};
    return fmt::format(
        "{} holds files that no watch wrote; move them, or name another folder by --out",
        results_.string());
  }

  void mark_folder() const {
    std::error_code unreadable;
    if (!results_.empty() && fs::is_directory(results_, unreadable))
      std::ofstream(results_ / mark_of_watch)
          << "hyperlattice watch writes the results in this folder, and replaces them.\n";
  }

  /// Removes the checkpoint of a round that was stopped: the changed scene cannot go on from it.
  void give_up_run() const {
    if (!results_.empty()) remove_checkpoints(results_);
  }

  StopSignals signals_;
  WatchedFiles files_;
  std::string command_;
  std::vector<std::string> words_;
  fs::path results_;
  int round_ = 0;
};

}  // namespace

Command watch_command(CLI::App& program) {
  struct Arguments : SceneArguments {
    bool runs = false, quiet = false;
    fs::path directory;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand(
      "watch", "plan or run a scene again whenever it, or a file that it names, changes");
  arguments->declare(*command);
  CLI::Option* const runs =
      command->add_flag("--run", arguments->runs, "run the scene, in place of planning it");
  command
      ->add_option("--out", arguments->directory,
                   "folder for the results of --run (default: <scene>_watch here)")
      ->type_name("DIR")
      ->needs(runs);
  command->add_flag("--quiet", arguments->quiet, "no progress lines")->needs(runs);
  return {command, [arguments, &program] {
            const Arguments& given = *arguments;
            fs::path results = given.directory;
            if (given.runs && results.empty()) results = given.scene.stem().string() + "_watch";
            if (given.runs) choose_directory(results, given.scene);
            std::vector<std::string> words{"hyperlattice"};
            if (program.count("--no-plugins") > 0) words.emplace_back("--no-plugins");
            const auto add = [&](const std::string& option, const std::string& value) {
              words.push_back(option);
              words.push_back(value);
            };
            const std::string of_rounds = given.runs ? "run" : "plan";
            add(of_rounds, given.scene.string());
            for (const std::string& setting : given.settings) add("--set", setting);
            if (given.threads.threads > 0) add("--threads", std::to_string(given.threads.threads));
            if (!given.from.empty()) add("--from", given.from.string());
            if (given.runs) add("--out", results.string());
            if (given.quiet) words.emplace_back("--quiet");
            std::vector<fs::path> others;
            if (!given.from.empty()) others.push_back(given.from / state_file);
            return Watch(WatchedFiles(given.scene, given.settings, others), of_rounds,
                         std::move(words), std::move(results))
                .run();
          }};
}

}  // namespace hyperlattice
