// What is checked of a study's runs before the first of them begins.
#pragma once

#include <plan/plan.hpp>
#include <study/rows.hpp>
#include <study/study_file.hpp>

namespace hyperlattice::study {

/// Faults that runs have: what is common to all is said once, the rest with the runs that have it.
class RunFaults {
 public:
  void add(const InputError& error, const std::string& run,
           const std::string& prefix);        ///< the prefix says whose pointers they are
  void throw_if_any(std::size_t runs) const;  ///< InputError; `runs`: how many there are

 private:
  struct Found {
    Fault fault;
    std::vector<std::string> runs;
  };
  std::vector<Found> found_;
};

/// Every comparison must find its probe and its column. Throws InputError.
void check_columns(const Study& study, const std::vector<PlannedTable>& tables);

/// What is known of a run before it, or of one that is there.
struct Foreseen {
  std::vector<PlannedTable> tables;
  double end_time = infinity;  ///< s
  double step = 0;             ///< s, by less than which a solver may pass the end
};

/// The truth of a row must be there, must not be zero and must not lie at times alone that the run
/// does not reach, as far as that is known before its run: `foreseen` is null if nothing is. Throws
/// InputError.
void check_truth(const Study& study, const Row& row, const Foreseen* foreseen);

/// The tables that the scene's probes left in a finished run; nothing if one is missing.
std::optional<std::vector<PlannedTable>> tables_in(const std::filesystem::path& run_directory,
                                                   const Scene& scene);

/// Why the tables of a scene's probes are not as the run that is done left them, by its list of
/// files: "probes/point.csv has changed"; empty: they are.
std::string changed_table(const std::filesystem::path& run_directory, const Scene& scene);

}  // namespace hyperlattice::study
