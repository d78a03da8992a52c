// The result of a run as a curve, from the table of a probe.
#pragma once

#include <study/comparison.hpp>

namespace hyperlattice::study {

/// Returns why a table with these columns does not suit the comparison; empty if it does.
std::string column_fault(const Comparison& comparison, const std::vector<std::string>& columns);

/// Returns the compared quantity over time, or, at the last time, over a coordinate of the places
/// in its columns' names. Throws std::runtime_error with a sentence if the table does not have it.
Curve observed_curve(const Comparison& comparison, const CsvTable& table);

/// Returns the place, m, at which the truth is taken; nothing if the comparison has none.
std::optional<double> place_of(const Comparison& comparison, const CsvTable& table);

}  // namespace hyperlattice::study
