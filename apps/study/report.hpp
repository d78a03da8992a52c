// A study's results as text, JSON, table and plot.
#pragma once

#include <study/evaluate.hpp>

namespace hyperlattice::study {

std::string study_text(const Study& study, const std::vector<Row>& rows, const Findings& findings);
Json study_json(const Study& study, const std::vector<Row>& rows, const Findings& findings);
std::string study_csv(const Study& study, const std::vector<Row>& rows, const Findings& findings);

/// Error against run time in gnuplot's commands, a line for each choice of everything but the
/// refinement; empty if no run has an error.
std::string study_script(const Study& study, const std::vector<Row>& rows,
                         const Findings& findings);

/// "The cheapest setting for an error of 1 % is ...": the answer in a sentence; empty if no error
/// is sought.
std::string cheapest_sentence(const Study& study, const std::vector<Row>& rows,
                              const Findings& findings);

/// Rows that differ in the refinement alone, from the coarsest on; without a refinement each row is
/// one of its own.
std::vector<std::vector<std::size_t>> families(const Study& study, const std::vector<Row>& rows);

}  // namespace hyperlattice::study
