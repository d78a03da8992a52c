// The commands of the program, one file each. A command declares its arguments, and acts when it
// was the one named.
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

struct Command {
  CLI::App* arguments = nullptr;
  std::function<int()> act;  ///< returns the exit code
};

Command run_command(CLI::App& program);
Command plan_command(CLI::App& program);
Command plugins_command(CLI::App& program);
Command schema_command(CLI::App& program);
Command analyze_command(CLI::App& program);
Command calibrate_command(CLI::App& program);
Command study_command(CLI::App& program);
Command report_command(CLI::App& program);

/// Writes the project of a plugin of that type into a new folder, by default ./<name>. InputError
/// if there is no such family, or the folder is there.
int write_new_plugin(const std::string& type, std::filesystem::path folder);

/// Prints a line for each check of the components' contracts, and the counts; exit_run if one
/// failed. `pictures`: see contract::check.
int test_plugins(Host& host, const std::vector<const Component*>& components,
                 const std::filesystem::path& pictures, bool json);

/// The folder of the results: <input>_out here, if none was given. InputError if something else
/// stands there.
void choose_directory(std::filesystem::path& directory, const std::filesystem::path& input);

/// A signal that would end the program stops the run after its present step instead: an
/// interruption, the end of a terminal or a batch system's time, a closed pipe. A second
/// interruption ends the program at once.
void stop_gently_when_interrupted();

/// --threads.
struct ThreadArgument {
  int threads = 0;  ///< 0: nobody asked for a number

  void declare(CLI::App& command);
  Threads count() const;
};

/// What `run` and `plan` are both told.
struct SceneArguments {
  std::filesystem::path scene;
  std::vector<std::string> settings;
  ThreadArgument threads;

  void declare(CLI::App& command);
  std::unique_ptr<Plan> plan(Host& host) const;
};

/// What `analyze` and `calibrate` are both told.
struct LatticeArguments {
  std::string lattice = bundled::cubic;
  std::vector<std::string> options;
  MembraneChoice membrane;

  void declare(CLI::App& command);
  std::vector<std::filesystem::path> files() const;  ///< that options may name: their values
};

}  // namespace hyperlattice
