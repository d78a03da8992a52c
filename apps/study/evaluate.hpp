// Evaluates finished runs: errors, orders of convergence, Pareto front, cheapest setting, run times
// at equal error.
#pragma once

#include <study/equal_error.hpp>
#include <study/front.hpp>
#include <study/order.hpp>

namespace hyperlattice::study {

/// The observed order of convergence for one choice of all axes but the refinement.
struct ChoiceOrder {
  Choice choice;  ///< that of the refinement counts for nothing
  ObservedOrder observed;
};

/// The distance between the limits of two settings of the same case. A limit is the extrapolation
/// from the finest runs.
struct LimitGap {
  Choice one, other;  ///< that of the refinement counts for nothing
  double apart = 0;   ///< in the norm of the study
};

/// What the rows of a study show together.
struct Findings {
  std::vector<bool> pareto;         ///< for each row: it is on the Pareto front
  std::vector<ChoiceOrder> orders;  ///< empty without a refinement
  std::vector<LimitGap> limits;  ///< only if the truth is the finest run: each setting against the
                                 ///< first setting of the same case
  std::vector<EqualError> equal_errors;
  std::optional<double> target;  ///< the target error
  /// Row of the cheapest setting with an error of at most the target.
  std::optional<std::size_t> cheapest;
  std::optional<std::size_t> best;  ///< row of the most accurate setting
};

/// Computes the errors of the rows from the tables in `directory`, and returns the distances
/// between limits. A run that cannot be compared becomes a failed row with the reason. A run stays
/// done, without error but with a reason, if its truth is a limit that the runs do not show.
std::vector<LimitGap> find_errors(const Study& study, const std::filesystem::path& directory,
                                  std::vector<Row>& rows);

/// Computes the findings from rows with errors.
Findings find(const Study& study, const std::vector<Row>& rows, std::vector<LimitGap> limits = {});

/// Returns the number of cases in the rows; 1 without cases.
std::size_t count_cases(const Study& study, const std::vector<Row>& rows);

}  // namespace hyperlattice::study
