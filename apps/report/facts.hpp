// The figures of a run for a table: what ran, how large, how long.
#pragma once

#include <report/record.hpp>

namespace hyperlattice::report {

/// A figure of summary.json.
struct Fact {
  std::string name;     ///< "Particles"
  std::string pointer;  ///< "/particles"
  std::string text;     ///< "490 432"; empty: the run does not have it
};

/// All figures that a report shows, in order: the same names for every run.
std::vector<Fact> facts(const RunRecord& run);

/// The same figures as they stand in summary.json, under the same keys; those that the run has.
Json figures(const RunRecord& run);

}  // namespace hyperlattice::report
