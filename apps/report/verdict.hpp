// Is it stable, and is it right? What a run's numbers say, in sentences.
#pragma once

#include <report/record.hpp>

namespace hyperlattice::report {

enum class Judgement {
  fine,
  doubtful,
  wrong,
  plain
};  ///< plain: a fact that speaks neither for nor against
inline constexpr std::string_view judgement_names[] = {"fine", "doubtful", "wrong", "plain"};

struct Finding {
  std::string about;  ///< "time_step", "energy_balance", "rest", "momentum", "broken_springs",
                      ///< "warning", "failing_motion", "progress", "checkpoint", "reason", "note"
  Judgement judgement = Judgement::plain;
  std::string sentence;
  Json numbers;  ///< what the sentence tells, in SI
};

/// In the order in which a sceptic asks.
std::vector<Finding> verdict(const RunRecord& run);

}  // namespace hyperlattice::report
