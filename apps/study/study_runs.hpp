// Runs all points of a study, and reuses runs that exist already.
#pragma once

#include <study/folder_lock.hpp>
#include <study/grid.hpp>
#include <study/rows.hpp>

#include <host/host.hpp>
#include <plan/threads.hpp>

namespace hyperlattice::study {

/// Options of run_study().
struct StudyRunOptions {
  std::filesystem::path directory;  ///< folder of the study's results; runs are in runs/<name>/,
                                    ///< further repeats of a run in runs/<name>/repeat_2/ ...
  Threads threads = 1;              ///< for runs whose threads the study does not vary
  bool fresh = false;               ///< repeat runs that exist already
};

/// Results of run_study().
struct StudyResult {
  std::vector<Row> rows;     ///< one for each point, in the order of the grid
  bool interrupted = false;  ///< a signal stopped the study before its end
  FolderLock lock;           ///< on the study's folder, until its results are written
};

/// Runs a study. First checks the folder, which must not contain a run or foreign files with the
/// names of a study's results, and every scene; throws InputError with all faults before anything
/// is written. Then locks the folder and runs all points once for each repeat, so that a change of
/// the machine's speed affects all points alike. Reuses a finished run with the same threads and
/// the same identity (plan/identity.hpp); if the identity differs, the log says what changed. A
/// failed run is a row with its reason.
StudyResult run_study(const Study& study, const std::vector<Point>& points,
                      const StudyRunOptions& options, Host& host);

/// Returns the folder of a repeat of a run; repeats count from 1.
std::filesystem::path run_directory(const std::filesystem::path& directory, const std::string& run,
                                    std::int64_t repeat);

}  // namespace hyperlattice::study
