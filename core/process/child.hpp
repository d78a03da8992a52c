// Another program that runs as a child, with a time limit.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hyperlattice {

/// How a child process ended.
struct ChildEnd {
  bool started = false;    ///< false: the program could not be started
  bool timed_out = false;  ///< it and its own children were killed
  int exit_code = -1;      ///< -1 if a signal ended it
};

/// Runs a program without a shell and waits for its end. `arguments`: the program, which is looked
/// for in PATH if it has no "/", then its arguments. It reads nothing; both its outputs go to the
/// file `output`. Programs may run at the same time on several threads.
ChildEnd run_child(const std::vector<std::string>& arguments, const std::filesystem::path& output,
                   double most_seconds);

/// Returns the file of a program, by PATH if it has no "/"; empty if there is none.
std::filesystem::path find_program(const std::string& program);

}  // namespace hyperlattice
