// The kinds of failure of a command, each with its exit code (docs/guide: exit codes).
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice {

/// One error in the input.
struct Fault {
  /// JSON pointer, for example "/pipeline/2/peak", or an option of the command line
  std::string pointer;
  std::string value;     ///< the wrong value as written; may be empty
  std::string expected;  ///< what was expected, with the nearest valid name if one exists
};

/// All faults of an input, shown together. Exit code 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Fault> faults);  ///< `faults`: at least one
  const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

/// The run failed: unstable, energy balance lost, or numbers not finite. Exit code 3.
class RunError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The environment failed: disk, memory, or a plugin. Exit code 4.
class OutsideError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum ExitCode : int {
  exit_done = 0,
  exit_input = 2,
  exit_run = 3,
  exit_outside = 4,
  exit_interrupted = 130
};

/// Collects what is wrong in an input: faults, so that a user sees all of them at once, and
/// warnings of what is accepted.
class Faults {
 public:
  void add(std::string pointer, std::string value, std::string expected);
  bool empty() const { return faults_.empty(); }
  std::size_t size() const { return faults_.size(); }
  const std::vector<Fault>& all() const { return faults_; }
  void throw_if_any() const;  ///< throws InputError with all faults

  /// Adds a warning about the value at a JSON pointer.
  void warn(std::string_view pointer, const std::string& sentence);
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  std::vector<Fault> faults_;
  std::vector<std::string> warnings_;
};

/// Returns the candidate nearest to `name` in spelling, or "" if none is near.
std::string nearest(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace hyperlattice
