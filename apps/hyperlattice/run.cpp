// hyperlattice run: plans a scene, runs it, writes its results.
#include "commands.hpp"

#include <ranks/launcher.hpp>
#include <run/run.hpp>

#include <spdlog/spdlog.h>

namespace hyperlattice {
void choose_directory(std::filesystem::path& directory, const std::filesystem::path& input) {
  if (directory.empty()) directory = input.stem().string() + "_out";
  std::error_code unreadable;  // not reported here (a link to itself, an unreadable parent folder):
                               // the creation of the folder reports it
  const bool is_link = std::filesystem::is_symlink(directory, unreadable);
  if ((is_link || std::filesystem::exists(directory, unreadable)) &&
      !std::filesystem::is_directory(directory, unreadable))
    throw InputError({{"--out", directory.string(),
                       is_link ? "a folder, a link to one, or a name that is free"
                               : "a folder, or a name that is free"}});
}

Command run_command(CLI::App& program) {
  struct Arguments : SceneArguments {
    RunOptions options;
    std::string engine;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand("run", "run a scene and write its results");
  arguments->declare(*command);
  command
      ->add_option("--out", arguments->options.directory,
                   "folder for the results (default: <scene>_out here)")
      ->type_name("DIR");
  command->add_flag(
      "--resume", arguments->options.resume,
      "go on with a run that was interrupted or cut off, from the checkpoint in its folder");
  command->add_flag("--keep-state", arguments->options.keep_state,
                    "keep the final state in the folder (state.bin), so that --from can start "
                    "another run there");
  command->add_flag(
      "--overwrite", arguments->options.overwrite,
      "give up an interrupted run in the folder, and replace files there that no run's list names");
  command
      ->add_option(
          "--checkpoint-every", arguments->options.checkpoint_every,
          "most seconds between checkpoints; the first come sooner (default: 600; 0: only when "
          "interrupted)")
      ->check(CLI::Range(0.0, 1e12));  // refuses nan
  command
      ->add_option("--engine", arguments->engine,
                   "what joins the processes that a launcher started: mpi, an engine of your own, "
                   "or none (default: mpi under mpirun or srun, else none)")
      ->type_name("NAME");
  command->add_flag("--quiet", arguments->options.quiet, "no progress lines");
  return {command, [arguments] {
            RunOptions& options = arguments->options;
            if (options.resume && options.overwrite)
              throw InputError({{"--overwrite", "",
                                 "either --resume or --overwrite: one keeps the run in the folder, "
                                 "the other gives it up"}});
            choose_directory(options.directory, arguments->scene);
            Host host;
            const auto ranks = join_ranks(host, arguments->engine);
            if (!ranks->is_first()) speak_no_more();  // all ranks find the same
            std::unique_ptr<Plan> plan;
            ranks->together([&] {
              plan = arguments->plan(host, ranks->count(), ranks->on_node(), ranks->is_first());
            });
            stop_gently_when_interrupted();
            return run(*plan, options, *ranks);
          }};
}

}  // namespace hyperlattice
