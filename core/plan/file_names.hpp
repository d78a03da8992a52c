// Names of files that every run may leave in its folder, so that no output may be called like one.
#pragma once

#include <base/errors.hpp>
#include <scene/scene.hpp>

namespace hyperlattice {

struct Plan;

inline constexpr const char* checkpoint_file = "checkpoint.bin";
inline constexpr const char* earlier_checkpoint_file =
    "checkpoint.previous.bin";  ///< the one before

inline constexpr std::string_view run_file_names[] = {
    "summary.json",          "scene.resolved.json", "history.csv", "failures.csv",
    "failing_motion.csv",    "files.csv",           "probes",      checkpoint_file,
    earlier_checkpoint_file, "report.html"};

/// What a writer or probe will call its files, in a folder inside the run's ("": that itself).
struct OutputName {
  std::string folder, base;
  double frames = 0;  ///< how many there may be: "base_000000...", beside "base..."; 0: `base` is
                      ///< the whole name of one file

  bool may_be(std::string_view name) const;  ///< whether a file may have this name
};
std::vector<OutputName> output_names(const Plan& plan);

/// A fault for each writer whose folder would be called like a file of the run or of another
/// writer.
void check_file_names(const Scene& scene, Faults& faults);

}  // namespace hyperlattice
