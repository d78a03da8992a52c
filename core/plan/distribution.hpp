// How a run is shared by its ranks: blocks, memory, what they exchange, and the time that this
// takes by a simple model.
#pragma once

#include <plan/plan.hpp>

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace hyperlattice {

/// What connects the ranks, and what each has.
struct Machine {
  double latency = 2e-6;         ///< of a message, s
  double bandwidth = 2e10;       ///< of a rank's messages, bytes/s
  std::optional<double> memory;  ///< of a rank, bytes
};

/// The part of one rank.
struct RankShare {
  std::uint64_t particles = 0;
  double state_bytes = 0;   ///< of its blocks
  double memory_bytes = 0;  ///< at most, with the model, the program, and outputs in the first rank
  double sent_bytes = 0;    ///< in a step
};

struct Distribution {
  std::vector<RankShare> shares;  ///< of each rank
  std::string whole;              ///< why every rank gets the whole state after each step; or ""
  double step_seconds = 0;        ///< of the rank with the most particles, without exchange
  double exchange_seconds = 0;    ///< after each step
  double efficiency = 1;          ///< mean share of its time in which a rank computes
  std::string whole_in_ranks;     ///< why every rank holds the whole state; "" if it does not
  /// Why the first rank gets the whole state for outputs; "" if it does not.
  std::string first_whole;
  std::optional<double> short_of;  ///< memory that a rank lacks, bytes
};

/// Returns how the plan's ranks share its run on a machine.
Distribution distribution_of(const Plan& plan, const Machine& machine);
nlohmann::json distribution_json(const Distribution& distribution);
std::string distribution_text(const Distribution& distribution);

}  // namespace hyperlattice
