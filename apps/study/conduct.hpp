// Runs what a study asks for, and takes up what is there already.
#pragma once

#include <study/folder_lock.hpp>
#include <study/grid.hpp>
#include <study/rows.hpp>

#include <host/host.hpp>
#include <plan/threads.hpp>

namespace hyperlattice::study {

struct ConductOptions {
  std::filesystem::path directory;  ///< of the study's results; the runs are in runs/<name>/,
                                    ///< further repeats of one in runs/<name>/repeat_2/ ...
  Threads threads = 1;              ///< of runs whose threads the study does not vary
  bool fresh = false;               ///< run again what is there already
};

struct Conducted {
  std::vector<Row> rows;     ///< one a point, in the grid's order
  bool interrupted = false;  ///< by a signal, before all was done
  FolderLock lock;           ///< on the study's folder, as long as its results are written
};

/// Checks the folder, which holds no run and no other file of the names of a study's results, and
/// then every scene; throws InputError with all faults, before anything is written. Then locks the
/// folder and runs the points in turn, once around for each repeat, so that a machine that changes
/// its speed is unfair to none. A run that is there, done, with the same threads and of the same
/// identity (plan/identity.hpp), is taken as it is; of another one the log says what changed. A run
/// that fails is a row with its reason.
Conducted conduct(const Study& study, const std::vector<Point>& points,
                  const ConductOptions& options, Host& host);

/// Where the files of a repeat (from 1) are.
std::filesystem::path run_directory(const std::filesystem::path& directory, const std::string& run,
                                    std::int64_t repeat);

}  // namespace hyperlattice::study
