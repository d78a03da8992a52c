// From runs that are done to what they teach: errors, orders of convergence, the Pareto front, the
// cheapest setting.
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

/// How far the limits are apart to which the finest runs of two settings lead that answer the same.
struct LimitGap {
  Choice one, other;  ///< that of the refinement counts for nothing
  double apart = 0;   ///< in the study's norm
};

struct Findings {
  std::vector<bool> pareto;         ///< of each row
  std::vector<ChoiceOrder> orders;  ///< none without a refinement
  std::vector<LimitGap> limits;  ///< only where the truth is the finest run: each setting's against
                                 ///< the first one of the same case
  std::optional<double> target;  ///< the error sought
  std::optional<std::size_t> cheapest;  ///< row with an error of at most the target
  std::optional<std::size_t> best;      ///< the most accurate row
};

/// Fills the rows' errors from the tables in `directory`, and returns how far limits are apart. A
/// run that cannot be compared fails with the reason; one whose truth would be a limit that the
/// runs do not show stays done, has no error, and a reason.
std::vector<LimitGap> find_errors(const Study& study, const std::filesystem::path& directory,
                                  std::vector<Row>& rows);

Findings find(const Study& study, const std::vector<Row>& rows, std::vector<LimitGap> limits = {});

/// Whether two choices differ in some axes alone.
bool same_but(const std::vector<std::size_t>& axes, Choice a, const Choice& b);

/// How many cases the rows ask about; 1 without cases.
std::size_t count_cases(const Study& study, const std::vector<Row>& rows);

}  // namespace hyperlattice::study
