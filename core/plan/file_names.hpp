// The names of files that every run may leave in its folder. No output may have such a name.
#pragma once

#include <base/errors.hpp>
#include <scene/scene.hpp>

namespace hyperlattice {

struct Plan;

inline constexpr const char* checkpoint_file = "checkpoint.bin";
inline constexpr const char* earlier_checkpoint_file =
    "checkpoint.previous.bin";  ///< the one before
inline constexpr const char* state_file = "state.bin";

inline constexpr std::string_view run_file_names[] = {
    "summary.json", "scene.resolved.json", "history.csv",
    "failures.csv", "failing_motion.csv",  "files.csv",
    "probes",       checkpoint_file,       earlier_checkpoint_file,
    state_file,     "report.html"};

/// The names of a writer's or probe's files, in a folder inside the run's ("": the run's folder).
struct OutputName {
  std::string folder, base;
  /// The number of files "base_000000..." beside "base..." at most; 0: one file, named `base`.
  double frames = 0;

  /// Returns whether a file may have this name.
  bool may_be(std::string_view name) const;
};
/// Returns the names of the files of all writers with an option `file` and of all probes.
std::vector<OutputName> output_names(const Plan& plan);

/// Adds a fault for each writer whose folder would have the name of a file of the run or of another
/// writer.
void check_file_names(const Scene& scene, Faults& faults);

}  // namespace hyperlattice
