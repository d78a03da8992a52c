// What the runs of a study gave: a row each.
#pragma once

#include <study/axes.hpp>

#include <cstdint>
#include <optional>

namespace hyperlattice::study {

struct Row {
  Choice choice;
  std::string run;       ///< its folder's name below runs/
  std::string identity;  ///< hash of all that it depends on
  std::vector<std::optional<double>>
      numbers;                     ///< what each axis was set to, in SI, where it is a number
  std::string status = "waiting";  ///< "waiting", "done", "failed"
  std::string reason;              ///< why it failed
  int exit_code = 0;               ///< of the run
  std::uint64_t particles = 0, steps = 0;
  std::vector<double> solve_seconds;  ///< of each repeat: apart from set-up and output
  double setup_seconds = 0;           ///< of the first
  std::vector<double> errors;         ///< of each comparison; empty: none is known
  std::optional<double> error;        ///< the largest of them

  bool is_done() const { return status == "done"; }
  double seconds() const;  ///< the median; 0 if nothing was timed
  void fail(std::string why, int code);
};

}  // namespace hyperlattice::study
