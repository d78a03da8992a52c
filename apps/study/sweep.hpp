// The results of a study without a truth: the values of chosen outputs over the grid.
#pragma once

#include <study/rows.hpp>
#include <study/study_file.hpp>

namespace hyperlattice::study {

/// Returns the values of a row, in the SI units of the probes, by the names of the study's
/// "compare"; an empty object for a run that failed.
Json values_json(const Study& study, const Row& row);

/// Returns the table of all rows for a terminal, and as CSV.
std::string sweep_table(const Study& study, const std::vector<Row>& rows);
std::string sweep_csv(const Study& study, const std::vector<Row>& rows);

/// Returns a plot for each output as gnuplot commands: the values over the first axis that has
/// several numbers, with a line for each choice of the other axes. Empty if no axis has numbers or
/// no run has values.
std::string sweep_script(const Study& study, const std::vector<Row>& rows);

/// Height of this picture, pixels.
int sweep_height(const Study& study);

}  // namespace hyperlattice::study
