// The plots of a report, from what runs recorded.
#pragma once

#include <report/plot.hpp>
#include <report/record.hpp>

#include <span>

namespace hyperlattice::report {

/// Energies, balance error, broken springs if any broke, each probe; those that have points.
std::vector<Plot> plots_of(const RunRecord& run);

/// The same quantities of all runs together: a plot for each energy, for the balance, for broken
/// springs, and for each number of probes of the same name.
std::vector<Plot> plots_together(std::span<const RunRecord> runs);

}  // namespace hyperlattice::report
