// The commands of the program, one file each. A command declares its arguments; the program calls
// `act` of the command that the user named.
#pragma once

#include "components.hpp"

#include <analyze/membrane_choice.hpp>
#include <plan/plan.hpp>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hyperlattice {

/// A command of the program.
struct Command {
  CLI::App* arguments = nullptr;
  std::function<int()> act;  ///< returns the exit code
};

Command run_command(CLI::App& program);
Command plan_command(CLI::App& program);
Command watch_command(CLI::App& program);
Command plugins_command(CLI::App& program);
Command schema_command(CLI::App& program);
Command analyze_command(CLI::App& program);
Command calibrate_command(CLI::App& program);
Command study_command(CLI::App& program);
Command report_command(CLI::App& program);
Command completion_command(CLI::App& program);
Command manual_command(CLI::App& program);

/// Writes the project of a plugin of this type into a new folder, by default ./<name>, or, if
/// `folder` is the name of a source (my_law.cpp), one file. Throws InputError if the family is
/// unknown or the folder or file exists.
int write_new_plugin(const std::string& type, std::filesystem::path folder);

/// Runs the contract tests of the components; prints a line for each check and the counts. Returns
/// exit_run if a check failed. `pictures`: see contract::check.
int test_plugins(Host& host, const std::vector<const Component*>& components,
                 const std::filesystem::path& pictures, bool json);

/// Sets an empty `directory` to <input>_out in the working directory. Throws InputError if
/// something that is not a folder has this name.
void choose_directory(std::filesystem::path& directory, const std::filesystem::path& input);

/// Installs signal handlers that stop the run after its present step, for an interruption, the end
/// of a terminal, the time limit of a batch system or a closed pipe. A second interruption ends the
/// program at once.
void stop_gently_when_interrupted();

/// Ends all messages of this process but the last words of a crash: of a rank that is not the
/// first.
void speak_no_more();

/// The argument --threads.
struct ThreadArgument {
  int threads = 0;  ///< 0: not given

  void declare(CLI::App& command);
  /// Returns the threads of each of so many ranks on this machine.
  Threads count(int node_ranks = 1) const;
};

/// The argument --plugin-path.
struct PluginPathArgument {
  std::vector<std::filesystem::path> paths;  ///< folders, libraries, source files

  void declare(CLI::App& command);
  /// Returns the paths with the library of each source file in its place. Throws InputError if a
  /// source does not compile, OutsideError if there is no compiler.
  std::vector<std::filesystem::path> libraries() const;
};

/// The arguments that `run` and `plan` share.
struct SceneArguments {
  std::filesystem::path scene;
  std::vector<std::string> settings;
  std::filesystem::path from;  ///< folder of the run at whose end the run starts; empty: none
  ThreadArgument threads;

  void declare(CLI::App& command);
  /// `writes`: see make_plan().
  std::unique_ptr<Plan> plan(Host& host, int ranks = 1, int node_ranks = 1,
                             bool writes = true) const;
};

/// The arguments that `analyze` and `calibrate` share.
struct LatticeArguments {
  std::string lattice = bundled::cubic;
  std::vector<std::string> options;
  MembraneChoice membrane;

  void declare(CLI::App& command);
  /// The values of the options, which may be names of input files.
  std::vector<std::filesystem::path> files() const;
};

}  // namespace hyperlattice
