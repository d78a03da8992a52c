// hyperlattice run: plans a scene, runs it, writes its results.
#include "commands.hpp"

#include <run/run.hpp>

#include <csignal>

namespace hyperlattice {
namespace {

/// The first interruption stops the run after its present step; a second one ends the program at once.
void stop_gently_when_interrupted() {
  struct sigaction action {};
  action.sa_handler = [](int) { request_stop(); };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

Command run_command(CLI::App& program) {
  struct Arguments : SceneArguments {
    RunOptions options;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand("run", "run a scene and write its results");
  arguments->declare(*command);
  command->add_option("--out", arguments->options.directory, "folder for the results (default: <scene>_out here)")->type_name("DIR");
  command->add_flag("--quiet", arguments->options.quiet, "no progress lines");
  return {command, [arguments] {
            RunOptions& options = arguments->options;
            if (options.directory.empty()) options.directory = arguments->scene.stem().string() + "_out";
            if (std::filesystem::exists(options.directory) && !std::filesystem::is_directory(options.directory))
              throw InputError({{"--out", options.directory.string(), "a folder, or a name that is free"}});
            Host host;
            const auto plan = arguments->plan(host);
            stop_gently_when_interrupted();
            return run(*plan, options);
          }};
}

}  // namespace hyperlattice
