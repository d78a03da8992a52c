// summary.json: the facts of a run and how it ended.
#pragma once

#include <plan/plan.hpp>
#include <run/history.hpp>

#include <nlohmann/json_fwd.hpp>

namespace hyperlattice {

/// The result of a run.
struct Outcome {
  std::string status = "done";  ///< "done", "failed", "interrupted"
  std::string reason;           ///< a sentence, unless the status is done
  int exit_code = 0;
  double setup_seconds = 0;  ///< of this process
  /// Seconds, summed like `steps` over all parts of a resumed run.
  double solve_seconds = 0, output_seconds = 0;
  Record last;                           ///< the latest record with finite numbers
  double largest_relative_error = 0;     ///< of the energy balance, over all records
  std::vector<double> injected_by_load;  ///< J
  std::optional<RestReport> rest;        ///< of the last stage that looked for rest
  std::uint64_t steps = 0;               ///< taken in all
  double time = 0;                       ///< reached time, s
  std::vector<std::string> warnings;     ///< in addition to the model's
  std::uint64_t state_hash = 0;
  std::vector<std::int64_t> peak_bytes;  ///< largest memory of each rank so far

  /// Sets how the run ended. The first status with an exit code other than 0 stays.
  void end(const char* new_status, int code, std::string why) {
    if (exit_code != 0) return;
    status = new_status;
    exit_code = code;
    reason = std::move(why);
  }
};

/// Returns the keys that product.md names, and a few more.
nlohmann::json summary_json(const Plan& plan, const Outcome& outcome);

}  // namespace hyperlattice
