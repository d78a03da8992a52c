// hyperlattice: the four-dimensional lattice spring model from the command line.
#include "commands.hpp"

#include <base/errors.hpp>
#include <host/crash.hpp>
#include <process/descriptors.hpp>
#include <process/environment.hpp>
#include <process/file_limit.hpp>
#include <process/lack_of_memory.hpp>
#include <ranks/ranks.hpp>
#include <scene/scene_plugins.hpp>

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <new>
#include <span>

namespace {
using namespace hyperlattice;

bool is_silent = false;

int complain(int code, const std::string& message) {
  if (!is_silent) std::cerr << "hyperlattice: " << message << '\n';
  return code;
}

void suggest(const std::string& word, const std::vector<std::string>& names) {
  if (const std::string near = hyperlattice::nearest(word, names); !near.empty())
    std::cerr << "Did you mean '" << near << "'?\n";
}

/// Suggests the command that is nearest to an unknown word.
void suggest_command(const CLI::App& program, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  suggest(word, names);
}

/// Suggests the options that are nearest to unknown words.
void suggest_options(const CLI::App& program, const CLI::App& command,
                     std::span<char* const> words) {
  std::vector<std::string> names;
  for (const CLI::App* known : {&program, &command})
    for (const CLI::Option* option : known->get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (const char* const word : words) {
    const std::string name = std::string(word).substr(0, std::string_view(word).find('='));
    if (name.starts_with("--") && name.size() > 2 &&
        std::find(names.begin(), names.end(), name) == names.end())
      suggest(name, names);
  }
}

/// Reports an error of the scene or the run; as lack of memory, if that is its cause.
int complain_of_scene(int code, const std::string& message) {
  return memory_ran_out() ? complain(exit_outside, lack_of_memory() + "\n" + message)
                          : complain(code, message);
}

/// Refuses nan and inf for numbers and an empty text for a file, which CLI11 accepts.
void refuse_odd_values(CLI::App& command) {
  const auto finite = [](const std::string& text) {
    double number = 0;
    return CLI::detail::lexical_cast(text, number) && !std::isfinite(number)
               ? text + " is not a finite number"
               : std::string();
  };
  const auto named = [](const std::string& text) {
    return text.empty() ? std::string("a name that is not empty was expected") : std::string();
  };
  for (CLI::Option* option : command.get_options()) {
    if (option->get_type_name().find("FLOAT") != std::string::npos) option->check(finite);
    if (option->get_name() == "--out") option->check(named);
  }
}

int obey(int count, char** words) {
  // Log on standard error: standard output is for the results of a command.
  spdlog::set_default_logger(spdlog::stderr_logger_mt("hyperlattice"));
  spdlog::set_pattern("hyperlattice: %v");
  CLI::App program("Simulates solids with the four-dimensional lattice spring model.",
                   "hyperlattice");
  program.set_version_flag("--version", "hyperlattice " HYPERLATTICE_VERSION);
  program.footer(
      "Exit codes: 0 done, 2 wrong input, 3 the run failed, 4 the outside failed (disk, memory, "
      "plugin), 130 interrupted.");
  program.fallthrough();  // options of the program may follow a command
  bool no_plugins = false;
  program.add_flag(
      "--no-plugins", no_plugins,
      "refuse scenes that name \"plugins\", whose code would run: for scenes from elsewhere");
  const Command commands[] = {
      run_command(program),        plan_command(program),   watch_command(program),
      plugins_command(program),    schema_command(program), analyze_command(program),
      calibrate_command(program),  study_command(program),  report_command(program),
      completion_command(program), manual_command(program)};
  for (const Command& command : commands) refuse_odd_values(*command.arguments);
  try {
    program.parse(count, words);
    if (no_plugins) refuse_scene_plugins();
    check_environment();
    for (const Command& command : commands)
      if (command.arguments->parsed()) return command.act();
  } catch (const CLI::ParseError& error) {
    const int code = program.exit(error);
    const auto named = program.get_subcommands();
    if (code != 0 && named.empty() && count > 1) suggest_command(program, words[1]);
    if (code != 0 && !named.empty())
      suggest_options(program, *named.front(), {words + 1, static_cast<std::size_t>(count - 1)});
    return code == 0 ? exit_done : exit_input;
  } catch (const InputError& error) {
    return complain_of_scene(exit_input,
                             "wrong input, nothing was written\n" + std::string(error.what()));
  } catch (const RunError& error) {
    return complain_of_scene(exit_run, error.what());
  } catch (const OtherRankError& error) {
    return complain(error.exit_code(), error.what());
  } catch (const std::bad_alloc&) {
    return complain(exit_outside,
                    lack_of_memory() + "\n`hyperlattice plan SCENE` says how much a scene needs");
  } catch (const std::exception& error) {
    return complain(exit_outside, error.what());
  }
  std::cerr << program.help();
  return exit_input;
}

}  // namespace

void hyperlattice::speak_no_more() {
  is_silent = true;
  spdlog::set_level(spdlog::level::off);
}

int main(int count, char** words) try {
  open_missing_streams();
  watch_memory();
  const FileLimitGuard file_limit;
  report_crashes();
  const int code = obey(count, words);
  if (std::cout.flush()) return code;
  complain(exit_outside,
           "cannot write all of what was to be printed: standard output is closed, or the device "
           "behind it is full or gone");
  return code == exit_done ? exit_outside : code;
} catch (const std::bad_alloc&) {
  std::cerr << "hyperlattice: not enough memory\n";
  return hyperlattice::exit_outside;
} catch (const std::exception& error) {
  std::cerr << "hyperlattice: " << error.what() << '\n';
  return hyperlattice::exit_outside;
}
