// What a run observed, as a curve: from the table that a probe left.
#pragma once

#include <study/comparison.hpp>

namespace hyperlattice::study {

/// Why a probe's table of these columns does not suit the comparison; empty if it does.
std::string column_fault(const Comparison& comparison, const std::vector<std::string>& columns);

/// The compared quantity over time, or, at the last time, over a coordinate of its columns' places.
/// Throws std::runtime_error with a sentence if the table does not have it.
Curve observed_curve(const Comparison& comparison, const CsvTable& table);

/// The place in metres at which the truth is taken; nothing if the comparison has none.
std::optional<double> place_of(const Comparison& comparison, const CsvTable& table);

}  // namespace hyperlattice::study
