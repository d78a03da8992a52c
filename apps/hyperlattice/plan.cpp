// hyperlattice plan: what a run will load, allocate and compute, and what it leaves out; computes nothing.
#include "commands.hpp"

#include <nlohmann/json.hpp>

#include <iostream>
#include <thread>

namespace hyperlattice {

void ThreadArgument::declare(CLI::App& command) {
  command.add_option("--threads", threads, "threads to run on; results do not depend on it (default: every processor)")->check(CLI::Range(1, 4096));
}

int ThreadArgument::count() const { return threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

void SceneArguments::declare(CLI::App& command) {
  command.add_option("SCENE", scene, "the scene file (JSON)")->required();
  command.add_option("--set", settings, "replace a value of the scene, e.g. --set /pipeline/1/poisson=0.23; may be repeated")
      ->type_name("/POINTER=VALUE")
      ->allow_extra_args(false);
  threads.declare(command);
}

std::unique_ptr<Plan> SceneArguments::plan(Host& host) const { return make_plan(read_scene(scene, settings, host), threads.count()); }

Command plan_command(CLI::App& program) {
  struct Arguments : SceneArguments {
    bool json = false;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand("plan", "check a scene and say what a run of it will do");
  arguments->declare(*command);
  command->add_flag("--json", arguments->json, "print it for machines");
  return {command, [arguments] {
            Host host;
            const auto plan = arguments->plan(host);
            std::cout << (arguments->json ? plan_json(*plan).dump(2) + "\n" : plan_text(*plan)) << std::flush;
            return exit_done;
          }};
}

}  // namespace hyperlattice
