// summary.json: what a run was and how it ended.
#pragma once

#include <plan/plan.hpp>
#include <run/history.hpp>

#include <nlohmann/json_fwd.hpp>

namespace hyperlattice {

/// How a run went.
struct Outcome {
  std::string status = "done";  ///< "done", "failed", "interrupted"
  std::string reason;           ///< of a status other than done, a sentence
  int exit_code = 0;
  double setup_seconds = 0;  ///< of this process
  double solve_seconds = 0,
         output_seconds = 0;  ///< also of the parts that this process went on from, as `steps`
  Record last;                ///< the latest record with finite numbers
  double largest_relative_error = 0;     ///< of the energy balance, over all records
  std::vector<double> injected_by_load;  ///< J
  std::optional<RestReport> rest;        ///< of the last stage that looked for rest
  std::uint64_t steps = 0;               ///< taken
  double time = 0;                       ///< reached, s
  std::vector<std::string> warnings;     ///< beside the model's
  std::uint64_t state_hash = 0;

  /// The first reason not to be done is the one that counts.
  void end(const char* new_status, int code, std::string why) {
    if (exit_code != 0) return;
    status = new_status;
    exit_code = code;
    reason = std::move(why);
  }
};

/// The keys that product.md names, and a few more.
nlohmann::json summary_json(const Plan& plan, const Outcome& outcome);

}  // namespace hyperlattice
