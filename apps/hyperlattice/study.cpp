// hyperlattice study: error against run time. Runs a scene over a grid of settings and compares
// each run with the truth.
#include "commands.hpp"

#include <quantities/units.hpp>
#include <ranks/launcher.hpp>
#include <study/perform.hpp>

#include <spdlog/spdlog.h>

#include <algorithm>
#include <iostream>

namespace hyperlattice {
namespace {

using namespace study;
using study::Row;

struct Arguments {
  std::filesystem::path study;
  std::vector<std::string> settings;
  std::string target_error;
  std::vector<std::filesystem::path> peers;
  StudyRunOptions options;
  ThreadArgument threads;
  bool json = false;
};

/// Reads "1%" or 0.01 as 0.01.
double read_target(const std::string& text) {
  const auto plain = csv_number(text);
  const Quantity fraction = plain ? Quantity{*plain, ""} : read_quantity(text, "");
  if (!fraction.problem.empty() || !(fraction.value > 0))
    throw InputError({{"--target-error", text, "an error above 0 such as 1% or 0.01"}});
  return fraction.value;
}

int exit_code(const StudyResult& done) {
  if (done.interrupted) return exit_interrupted;
  int code = exit_done;
  for (const Row& row : done.rows) code = std::max(code, row.exit_code);
  return code;
}

int run_study(Arguments a) {
  must_be_one_process("study");
  Study study = read_study(a.study, a.settings);
  if (!a.target_error.empty()) study.target_error = read_target(a.target_error);
  Faults faults;
  for (const auto& file : a.peers) append_peers(study.peers, file, "--peers", faults);
  check_sweep(study, "--target-error", "--peers", faults);
  faults.throw_if_any();
  StudyRunOptions& options = a.options;
  options.threads = a.threads.count();
  choose_directory(options.directory, a.study);

  Host host;
  stop_gently_when_interrupted();
  const auto [done, findings] = perform(study, options, host);
  std::cout << (a.json ? json_text(study_json(study, done.rows, findings))
                       : study_text(study, done.rows, findings))
            << std::flush;
  spdlog::info("{}, results in {}",
               done.interrupted ? "interrupted; the same command goes on from here" : "done",
               options.directory.string());
  return exit_code(done);
}

}  // namespace

Command study_command(CLI::App& program) {
  const auto a = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand(
      "study",
      "error against run time: run a scene over a grid of settings and compare it with the truth");
  command->add_option("STUDY", a->study, "the study file (JSON)")->required()->type_name("FILE");
  command
      ->add_option("--set", a->settings,
                   "replace a value of the study, e.g. --set /repeats=1; may be repeated")
      ->type_name("/POINTER=VALUE")
      ->allow_extra_args(false);
  command
      ->add_option(
          "--out", a->options.directory,
          "folder for the results (default: <study>_out here); what it holds is not run again")
      ->type_name("DIR");
  command->add_flag("--fresh", a->options.fresh, "run again what is there already");
  command
      ->add_option("--target-error", a->target_error,
                   "find the cheapest setting with at most this error, e.g. 1%")
      ->type_name("ERROR");
  command
      ->add_option("--peers", a->peers,
                   "put other programs' errors and times, label,error,seconds, into the plot; may "
                   "be repeated")
      ->type_name("CSV")
      ->allow_extra_args(false);
  a->threads.declare(*command);
  command->add_flag("--json", a->json, "print it for machines");
  return {command, [a] { return run_study(*a); }};
}

}  // namespace hyperlattice
