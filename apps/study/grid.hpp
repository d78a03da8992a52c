// The runs of a study: every combination of the axes' values that is not excluded, each with its
// own scene.
#pragma once

#include <study/study_file.hpp>

namespace hyperlattice::study {

struct Point {
  Choice choice;
  std::string name;            ///< of its folder: "spacing-4mm_boundary-cells"; unique
  Json scene;                  ///< not yet validated
  std::optional<int> threads;  ///< if the study varies them
};

/// The first axis varies slowest. Throws InputError if a value cannot be put into the scene, or if
/// nothing is left to run.
std::vector<Point> grid(const Study& study);

}  // namespace hyperlattice::study
