// Run times of the settings of a study at equal error.
#pragma once

#include <study/families.hpp>

namespace hyperlattice::study {

/// The run times of two settings of the same case at the same error: the least error of the first
/// setting, which the reference reaches too, since it has the most accurate run of the case.
struct EqualError {
  Choice setting, reference;  ///< that of the refinement counts for nothing
  double error = 0;
  double seconds = 0;            ///< s, of the setting
  double reference_seconds = 0;  ///< s, interpolated between two runs of the reference
  /// All runs of the reference are more accurate. `reference_seconds` is that of the quickest one.
  bool is_bound = false;

  double times() const { return seconds / reference_seconds; }
};

/// Compares each setting with the most accurate setting of its case; nothing without a refinement.
std::vector<EqualError> compare_at_equal_error(const Study& study, const std::vector<Row>& rows);

}  // namespace hyperlattice::study
