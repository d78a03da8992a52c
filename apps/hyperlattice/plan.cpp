// hyperlattice plan: shows what a run will load, allocate and compute, and what it leaves out;
// writes no file.
#include "commands.hpp"
#include "elapsed_time.hpp"

#include <plan/calibration.hpp>
#include <plan/shortage.hpp>
#include <process/processors.hpp>
#include <scene/json.hpp>

#include <nlohmann/json.hpp>

#include <charconv>
#include <cstdlib>
#include <iostream>

namespace hyperlattice {

namespace {

constexpr int most_threads = 4096;

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

Threads ThreadArgument::count() const {
  if (threads > 0) return threads;
  const char* wish = std::getenv("OMP_NUM_THREADS");
  if (wish == nullptr || *wish == '\0') return Threads::up_to(std::min(processors(), most_threads));
  // OpenMP lists one number for each level of nesting; the first one counts.
  const std::string_view list = wish, first = list.substr(0, list.find(','));
  int number = 0;
  const auto [end, error] = std::from_chars(first.data(), first.data() + first.size(), number);
  if (error != std::errc() || end != first.data() + first.size() || number < 1 ||
      number > most_threads)
    throw InputError(
        {{"OMP_NUM_THREADS", std::string(list),
          "in the environment, a number of threads from 1 to " + std::to_string(most_threads)}});
  return number;
}

void SceneArguments::declare(CLI::App& command) {
  command.add_option("SCENE", scene, "the scene file (JSON)")->required();
  command
      .add_option(
          "--set", settings,
          "replace a value of the scene, by its JSON pointer or by the name or type of a stage, "
          "e.g. "
          "--set /pipeline/1/poisson=0.23, --set solvers.explicit/end_time=2us; may be repeated")
      ->type_name("/POINTER=VALUE|NAME/OPTION=VALUE")
      ->allow_extra_args(false);
  threads.declare(command);
}

std::unique_ptr<Plan> SceneArguments::plan(Host& host) const {
  const ElapsedTime elapsed_time;
  auto read = read_scene(scene, settings, host);
  const Origins origins = read->origins;
  try {
    return make_plan(std::move(read), threads.count());
  } catch (const InputError& error) {
    throw origins.with_places(error);
  }
}

Command plan_command(CLI::App& program) {
  struct Arguments : SceneArguments {
    bool json = false;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      program.add_subcommand("plan", "check a scene and say what a run of it will do");
  arguments->declare(*command);
  command->add_flag("--json", arguments->json, "print it for machines");
  return {command, [arguments] {
            Host host;
            const auto plan = arguments->plan(host);
            for (std::string& missing : shortages(*plan, results_by_default(arguments->scene)))
              plan->model->warnings.push_back(std::move(missing));
            calibrate_run_time(*plan);
            std::cout << (arguments->json ? json_text(plan_json(*plan)) : plan_text(*plan))
                      << std::flush;
            return exit_done;
          }};
}

}  // namespace hyperlattice
