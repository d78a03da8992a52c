// The plots of probes: over time, or along their places for probes with many places.
#pragma once

#include <report/plot.hpp>
#include <report/record.hpp>

#include <span>

namespace hyperlattice::report {

/// Returns a plot over time for each quantity, with its components or its mean, least and greatest
/// value. For a probe with several places, returns a plot of each component along the places, at
/// some times.
std::vector<Plot> plots_of(const Probe& probe);

/// Returns a plot for each number of probes that have the same name in at least two runs, with a
/// curve for each run; plots along places show the last time.
std::vector<Plot> probes_together(std::span<const RunRecord> runs);

}  // namespace hyperlattice::report
