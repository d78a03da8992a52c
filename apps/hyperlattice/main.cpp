// hyperlattice: the four-dimensional lattice spring model from the command line.
#include "commands.hpp"

#include <base/errors.hpp>
#include <host/crash.hpp>
#include <scene/scene_plugins.hpp>

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <iostream>
#include <new>

namespace {

int complain(int code, const std::string& message) {
  std::cerr << "hyperlattice: " << message << '\n';
  return code;
}

/// Names the command that was most likely meant by a word that is none.
void suggest(const CLI::App& program, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) names.push_back(command->get_name());
  if (const std::string near = hyperlattice::nearest(word, names); !near.empty()) std::cerr << "Did you mean '" << near << "'?\n";
}

}  // namespace

int main(int count, char** words) {
  using namespace hyperlattice;
  report_crashes();
  spdlog::set_default_logger(spdlog::stderr_logger_mt("hyperlattice"));  // standard output is for what a command prints
  spdlog::set_pattern("hyperlattice: %v");
  CLI::App program("Simulates solids with the four-dimensional lattice spring model.", "hyperlattice");
  program.set_version_flag("--version", "hyperlattice " HYPERLATTICE_VERSION);
  program.footer("Exit codes: 0 done, 2 wrong input, 3 the run failed, 4 the outside failed (disk, memory, plugin), 130 interrupted.");
  program.fallthrough();  // an option of the program may stand behind a command
  bool no_plugins = false;
  program.add_flag("--no-plugins", no_plugins, "refuse scenes that name \"plugins\", whose code would run: for scenes from elsewhere");
  const Command commands[] = {run_command(program),     plan_command(program),      plugins_command(program), schema_command(program),
                              analyze_command(program), calibrate_command(program), study_command(program),   report_command(program)};
  try {
    program.parse(count, words);
    if (no_plugins) refuse_scene_plugins();
    for (const Command& command : commands)
      if (command.arguments->parsed()) return command.act();
  } catch (const CLI::ParseError& error) {
    const int code = program.exit(error);
    if (code != 0 && program.get_subcommands().empty() && count > 1) suggest(program, words[1]);
    return code == 0 ? exit_done : exit_input;
  } catch (const InputError& error) {
    return complain(exit_input, "wrong input, nothing was written\n" + std::string(error.what()));
  } catch (const RunError& error) {
    return complain(exit_run, error.what());
  } catch (const std::bad_alloc&) {
    return complain(exit_outside, "not enough memory; `hyperlattice plan SCENE` says how much a scene needs");
  } catch (const std::exception& error) {
    return complain(exit_outside, error.what());
  }
  std::cerr << program.help();
  return exit_input;
}
