// The plots of a report, from the tables of runs.
#pragma once

#include <report/plot.hpp>
#include <report/record.hpp>

#include <span>

namespace hyperlattice::report {

/// Returns the plots of one run that have points: energies, error of the energy balance, broken
/// springs (if any broke), each probe.
std::vector<Plot> plots_of(const RunRecord& run);

/// Returns plots that compare all runs: one for each energy, for the balance, for broken springs,
/// and for each number of probes of the same name.
std::vector<Plot> plots_together(std::span<const RunRecord> runs);

}  // namespace hyperlattice::report
