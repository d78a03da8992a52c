// Groups of rows of a study: settings that differ in the refinement alone, and cases.
#pragma once

#include <study/rows.hpp>
#include <study/study_file.hpp>

namespace hyperlattice::study {

/// Returns whether two choices differ at most in these axes.
bool same_but(const std::vector<std::size_t>& axes, Choice a, const Choice& b);

/// Returns whether two choices belong to the same case of the study; true without cases.
bool same_case(const Study& study, const Choice& a, const Choice& b);

/// Returns groups of rows that differ in the refinement alone, from the coarsest to the finest;
/// without a refinement each row is its own group.
std::vector<std::vector<std::size_t>> families(const Study& study, const std::vector<Row>& rows);

}  // namespace hyperlattice::study
