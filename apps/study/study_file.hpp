// The content of a study file: a scene, the axes, the truth and the norm of the error.
#pragma once

#include <scene/document.hpp>
#include <study/comparison.hpp>
#include <study/peers.hpp>

namespace hyperlattice::study {

/// The content of a study file.
struct Study {
  std::filesystem::path file;
  std::string title;
  Document scene;  ///< after the study's "set", not yet validated
  /// File of the scene; the study's own file if the scene is inline.
  std::filesystem::path scene_file;
  std::vector<Axis> axes;
  /// The axis whose values are sizes: spacing, or the axis that "refine" names.
  std::optional<std::size_t> refinement;
  std::vector<std::size_t> cases;  ///< axes that change the problem, not the method of its solution
  std::vector<Condition> excluded;
  std::vector<Truth> truths;
  std::vector<Comparison> comparisons;
  Norm norm = Norm::relative_l2;
  std::int64_t repeats = 3;
  std::optional<double> target_error;
  std::vector<Peer> peers;

  /// Whether the study has no truth: it then shows the values of the runs, not errors.
  bool is_sweep() const { return truths.empty(); }
};

/// Adds a fault for each thing that needs a truth in a study without one. `target` and `peers`: the
/// places of the target error and of the peers' tables.
void check_sweep(const Study& study, const std::string& target, const std::string& peers,
                 Faults& faults);

/// Reads a study, applies the settings (`--set`) and checks it. Throws InputError with every fault.
Study read_study(const std::filesystem::path& file, const std::vector<std::string>& settings);

}  // namespace hyperlattice::study
