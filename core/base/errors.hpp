// The ways a command can fail; each has its exit code (docs/guide: exit codes).
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice {

/// One thing wrong with the input.
struct Fault {
  std::string pointer;  ///< JSON pointer, e.g. "/pipeline/2/peak"; or an option of the command line
  std::string value;    ///< the offending value as written; may be empty
  std::string expected;  ///< what was expected, with the nearest valid name where there is one
};

/// All faults of an input, to be shown together. Exit code 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Fault> faults);  ///< at least one
  const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

/// The run itself failed: unstable, lost energy balance, non-finite. Exit code 3.
class RunError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The outside failed: disk, memory, a plugin. Exit code 4.
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

/// Collects faults, so that a user sees all of them at once.
class Faults {
 public:
  void add(std::string pointer, std::string value, std::string expected);
  bool empty() const { return faults_.empty(); }
  std::size_t size() const { return faults_.size(); }
  const std::vector<Fault>& all() const { return faults_; }
  void throw_if_any() const;  ///< InputError with everything collected

 private:
  std::vector<Fault> faults_;
};

/// The candidate nearest to `name` in spelling, or "" if none is near.
std::string nearest(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace hyperlattice
