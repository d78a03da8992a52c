// The results of a study as text, JSON, table and plot.
#pragma once

#include <study/evaluate.hpp>

namespace hyperlattice::study {

std::string study_text(const Study& study, const std::vector<Row>& rows, const Findings& findings);
Json study_json(const Study& study, const std::vector<Row>& rows, const Findings& findings);
std::string study_csv(const Study& study, const std::vector<Row>& rows, const Findings& findings);

/// Returns the plot of error against run time as gnuplot commands, with a line for each choice of
/// all axes but the refinement; empty if no run has an error.
std::string study_script(const Study& study, const std::vector<Row>& rows,
                         const Findings& findings);

/// Returns the answer, "The cheapest setting for an error of 1 % is ..."; empty without a target
/// error.
std::string cheapest_sentence(const Study& study, const std::vector<Row>& rows,
                              const Findings& findings);

}  // namespace hyperlattice::study
