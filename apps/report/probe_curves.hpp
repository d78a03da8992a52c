// The plots of probes: over time, or, of those that have many places, along these.
#pragma once

#include <report/plot.hpp>
#include <report/record.hpp>

#include <span>

namespace hyperlattice::report {

/// A plot for each quantity: its components, or its mean, least and greatest value, over time; of a
/// probe with several places each component along them, at some times.
std::vector<Plot> plots_of(const Probe& probe);

/// A plot for each number of the probes that at least two runs have by the same name, a curve a
/// run; along places at the last time.
std::vector<Plot> probes_together(std::span<const RunRecord> runs);

}  // namespace hyperlattice::report
