// hyperlattice run: plans a scene, runs it, writes its results.
#include "commands.hpp"

#include <run/run.hpp>

namespace hyperlattice {
void choose_directory(std::filesystem::path& directory, const std::filesystem::path& input) {
  if (directory.empty()) directory = input.stem().string() + "_out";
  if (std::filesystem::exists(directory) && !std::filesystem::is_directory(directory))
    throw InputError({{"--out", directory.string(), "a folder, or a name that is free"}});
}

Command run_command(CLI::App& program) {
  struct Arguments : SceneArguments {
    RunOptions options;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand("run", "run a scene and write its results");
  arguments->declare(*command);
  command->add_option("--out", arguments->options.directory, "folder for the results (default: <scene>_out here)")->type_name("DIR");
  command->add_flag("--resume", arguments->options.resume, "go on with a run that was interrupted or cut off, from the checkpoint in its folder");
  command
      ->add_option("--checkpoint-every", arguments->options.checkpoint_every, "seconds between checkpoints (default: 600; 0: only when interrupted)")
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--quiet", arguments->options.quiet, "no progress lines");
  return {command, [arguments] {
            RunOptions& options = arguments->options;
            choose_directory(options.directory, arguments->scene);
            Host host;
            const auto plan = arguments->plan(host);
            if (options.resume) prepare_to_resume(*plan, options.directory);
            stop_gently_when_interrupted();
            return run(*plan, options);
          }};
}

}  // namespace hyperlattice
