// The grid of a study: one run, with its own scene, for every combination of the axes' values that
// is not excluded.
#pragma once

#include <study/study_file.hpp>

namespace hyperlattice::study {

/// One point of the grid.
struct Point {
  Choice choice;
  std::string name;            ///< unique name of its folder, "spacing-4mm_boundary-cells"
  Json scene;                  ///< not yet validated
  std::optional<int> threads;  ///< only if the study varies them
};

/// Returns all points; the first axis varies slowest. Throws InputError if a value does not fit
/// into the scene, or if no point is left.
std::vector<Point> grid(const Study& study);

}  // namespace hyperlattice::study
