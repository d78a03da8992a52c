// A study as its file tells it: a scene, what to vary, the truth, and how the error is counted.
#pragma once

#include <study/comparison.hpp>
#include <study/peers.hpp>

namespace hyperlattice::study {

struct Study {
  std::filesystem::path file;
  std::string title;
  Json scene;  ///< with the study's "set" applied, not yet validated
  std::filesystem::path
      scene_file;  ///< where the scene stands; the study's own file if it is inline
  std::vector<Axis> axes;
  std::optional<std::size_t>
      refinement;  ///< the axis whose values are sizes: spacing, or what "refine" names
  std::vector<std::size_t> cases;  ///< axes that change what is asked, not how it is answered
  std::vector<Condition> excluded;
  std::vector<Truth> truths;
  std::vector<Comparison> comparisons;
  Norm norm = Norm::relative_l2;
  std::int64_t repeats = 3;
  std::optional<double> target_error;
  std::vector<Peer> peers;
};

/// Reads and checks a study, after the settings (`--set`) are applied to it. Throws InputError with
/// every fault found.
Study read_study(const std::filesystem::path& file, const std::vector<std::string>& settings);

}  // namespace hyperlattice::study
