// Curves of stress over strain: a load cell's column stress over a gauge's column strain.
#pragma once

#include <report/plot.hpp>
#include <report/record.hpp>

namespace hyperlattice::report {

/// Returns a plot with one curve for each probe that has a column "stress" and each that has a
/// column "strain" at the same times; without curves if the run has no such pair.
Plot stress_over_strain(const RunRecord& run);

}  // namespace hyperlattice::report
