// hyperlattice plan: shows what a run will load, allocate and compute, and what it leaves out;
// writes no file.
#include "commands.hpp"
#include "elapsed_time.hpp"
#include "machine.hpp"

#include <plan/calibration.hpp>
#include <plan/shortage.hpp>
#include <plan/thread_choice.hpp>
#include <run/final_state.hpp>
#include <scene/json.hpp>

#include <nlohmann/json.hpp>

#include <iostream>

namespace hyperlattice {

namespace {

constexpr int most_ranks = 1 << 20;

/// Returns the default folder of `run`; empty if something else has its name.
std::filesystem::path results_by_default(const std::filesystem::path& scene) {
  std::filesystem::path directory;
  try {
    choose_directory(directory, scene);
  } catch (const InputError&) {  // something else has this name; `run` will need --out
  }
  return directory;
}

}  // namespace

void ThreadArgument::declare(CLI::App& command) {
  command
      .add_option("--threads", threads,
                  "threads to run on; results do not depend on it (default: OMP_NUM_THREADS, else "
                  "every processor that it may use, but few for a small body)")
      ->check(CLI::Range(1, most_threads));
}

Threads ThreadArgument::count(int node_ranks) const { return chosen_threads(threads, node_ranks); }

void SceneArguments::declare(CLI::App& command) {
  command.add_option("SCENE", scene, "the scene file (JSON)")->required()->type_name("FILE");
  command
      .add_option(
          "--set", settings,
          "replace a value of the scene, by its JSON pointer or by the name or type of a stage, "
          "e.g. "
          "--set /pipeline/1/poisson=0.23, --set solvers.explicit/end_time=2us; may be repeated")
      ->type_name("/POINTER=VALUE|NAME/OPTION=VALUE")
      ->allow_extra_args(false);
  command
      .add_option("--from", from,
                  "start from the end of the run in this folder, which --keep-state kept: the same "
                  "body under the loads, solvers and outputs of this scene")
      ->type_name("DIR");
  threads.declare(command);
}

std::unique_ptr<Plan> SceneArguments::plan(Host& host, int ranks, int node_ranks,
                                           bool writes) const {
  const ElapsedTime elapsed_time;
  auto read = read_scene(scene, settings, host);
  std::optional<StartState> start;
  if (!from.empty()) start = read_start(from);
  return make_plan(std::move(read), threads.count(node_ranks), ranks, std::move(start), writes);
}

Command plan_command(CLI::App& program) {
  struct Arguments : SceneArguments {
    bool json = false;
    int ranks = 0;  // 0: not given
    std::filesystem::path machine;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      program.add_subcommand("plan", "check a scene and say what a run of it will do");
  arguments->declare(*command);
  command->add_flag("--json", arguments->json, "print it for machines");
  command
      ->add_option("--ranks", arguments->ranks,
                   "say how so many processes (mpirun -n) would share the run")
      ->check(CLI::Range(1, most_ranks));
  command
      ->add_option("--machine", arguments->machine,
                   "JSON file with latency (s) and bandwidth (bytes/s) of messages, and memory "
                   "(bytes) of a rank")
      ->type_name("FILE")
      ->needs("--ranks");
  return {command, [arguments] {
            Host host;
            const Machine machine = read_machine(arguments->machine);
            const auto plan = arguments->plan(host, std::max(1, arguments->ranks));
            for (std::string& missing : shortages(*plan, results_by_default(arguments->scene)))
              plan->model->warnings.push_back(std::move(missing));
            calibrate_run_time(*plan);
            nlohmann::json facts = plan_json(*plan);
            std::string text = plan_text(*plan);
            if (arguments->ranks > 0) {
              const Distribution shared = distribution_of(*plan, machine);
              facts["distribution"] = distribution_json(shared);
              text += distribution_text(shared);
            }
            std::cout << (arguments->json ? json_text(facts) : text) << std::flush;
            return exit_done;
          }};
}

}  // namespace hyperlattice
