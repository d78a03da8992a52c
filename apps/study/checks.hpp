// The checks of a study's runs before the first run begins.
#pragma once

#include <plan/plan.hpp>
#include <study/rows.hpp>
#include <study/study_file.hpp>

namespace hyperlattice::study {

/// Collects the faults of runs. A fault that all runs have is reported once; others with the names
/// of their runs.
class RunFaults {
 public:
  /// `prefix` goes before the pointers of the faults.
  void add(const InputError& error, const std::string& run, const std::string& prefix);
  void throw_if_any(std::size_t runs) const;  ///< throws InputError; `runs`: number of all runs

 private:
  struct SharedFault {
    Fault fault;
    std::vector<std::string> runs;
  };
  std::vector<SharedFault> found_;
};

/// Checks that the tables have the probe and the column of every comparison. Throws InputError.
void check_columns(const Study& study, const std::vector<PlannedTable>& tables);

/// The known properties of a planned or finished run.
struct RunProperties {
  std::vector<PlannedTable> tables;
  double end_time = infinity;  ///< s
  double step = 0;             ///< s; a solver passes the end time by less than this
};

/// Checks that the truth of a row exists, is not zero, and does not lie only at times that the run
/// does not reach. `properties`: the properties of the run; null if they are not known. Throws
/// InputError.
void check_truth(const Study& study, const Row& row, const RunProperties* properties);

/// Returns the tables of a finished run: history.csv, without a name, and those of the scene's
/// probes; nothing if one is missing.
std::optional<std::vector<PlannedTable>> tables_in(const std::filesystem::path& run_directory,
                                                   const Scene& scene);

/// Compares the tables of a finished run with the run's list of files. Returns the first
/// difference, as "probes/point.csv has changed"; empty if there is none.
std::string changed_table(const std::filesystem::path& run_directory, const Scene& scene);

}  // namespace hyperlattice::study
