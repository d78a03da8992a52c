// From runs that are done to what they teach: errors, orders of convergence, the Pareto front, the cheapest setting.
#pragma once

#include <study/front.hpp>
#include <study/order.hpp>
#include <study/rows.hpp>
#include <study/study_file.hpp>

namespace hyperlattice::study {

/// The order observed for one choice of everything but the refinement.
struct ChoiceOrder {
  Choice choice;  ///< that of the refinement counts for nothing
  ObservedOrder observed;
};

struct Findings {
  std::vector<bool> pareto;             ///< of each row
  std::vector<ChoiceOrder> orders;      ///< none without a refinement
  std::optional<double> target;         ///< the error sought
  std::optional<std::size_t> cheapest;  ///< row with an error of at most the target
  std::optional<std::size_t> best;      ///< the most accurate row
};

/// Fills the rows' errors from the tables in `directory`. A run that cannot be compared fails with the reason.
void find_errors(const Study& study, const std::filesystem::path& directory, std::vector<Row>& rows);

Findings find(const Study& study, const std::vector<Row>& rows);

}  // namespace hyperlattice::study
