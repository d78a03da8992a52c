// Judges whether a run is stable and right: sentences from the numbers of the run.
#pragma once

#include <report/record.hpp>

namespace hyperlattice::report {

/// The judgement of a finding; plain: a fact that is neither good nor bad.
enum class Judgement { fine, doubtful, wrong, plain };
inline constexpr std::string_view judgement_names[] = {"fine", "doubtful", "wrong", "plain"};

/// One sentence about a run.
struct Finding {
  std::string about;  ///< "time_step", "energy_balance", "rest", "momentum", "broken_springs",
                      ///< "warning", "failing_motion", "progress", "checkpoint", "reason", "note"
  Judgement judgement = Judgement::plain;
  std::string sentence;
  Json numbers;  ///< the numbers of the sentence, in SI
};

/// Returns the findings, the most critical questions first.
std::vector<Finding> verdict(const RunRecord& run);

}  // namespace hyperlattice::report
