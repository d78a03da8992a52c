// The results of a study's runs, one row for each point.
#pragma once

#include <study/axes.hpp>

#include <cstdint>
#include <optional>

namespace hyperlattice::study {

/// The results of one point of the grid.
struct Row {
  Choice choice;
  std::string run;       ///< name of its folder in runs/
  std::string identity;  ///< hash of everything that its results depend on
  /// The value of each axis in SI, if it is a number.
  std::vector<std::optional<double>> numbers;
  std::string status = "waiting";  ///< "waiting", "done", "failed"
  std::string reason;              ///< why the run failed or has no error
  int exit_code = 0;               ///< exit code of the run
  std::uint64_t particles = 0, steps = 0;
  std::vector<double> solve_seconds;  ///< s, for each repeat; without set-up and output
  double setup_seconds = 0;           ///< set-up time of the first repeat, s
  std::vector<double> values;         ///< of a study without a truth: one for each comparison
  std::vector<double> errors;         ///< one for each comparison; empty if not known
  /// Largest of errors; with Norm::together_l2, the error of all together.
  std::optional<double> error;

  bool is_done() const { return status == "done"; }
  double seconds() const;  ///< median of solve_seconds; 0 without a time
  void fail(std::string why, int code);
};

}  // namespace hyperlattice::study
