// The main numbers of a run for a table: component types, sizes, times.
#pragma once

#include <report/record.hpp>

namespace hyperlattice::report {

/// One number or text of summary.json.
struct Fact {
  std::string name;     ///< "Particles"
  std::string pointer;  ///< "/particles"
  std::string text;     ///< "490 432"; empty if the run does not have it
};

/// Returns all facts of a report, in order; the names are the same for every run.
std::vector<Fact> facts(const RunRecord& run);

/// Returns the same facts with the keys and values of summary.json, without those that the run does
/// not have.
Json figures(const RunRecord& run);

}  // namespace hyperlattice::report
