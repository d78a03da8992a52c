// A report of runs and studies: one page for people, the same figures for machines.
#pragma once

#include <report/differences.hpp>
#include <report/study_record.hpp>

namespace hyperlattice::report {

struct Report {
  std::vector<RunRecord> runs;
  std::vector<StudyRecord> studies;
  std::vector<Difference> differing;  ///< of the runs' scenes
};

/// Reads the folders. InputError with every fault of all of them: no folder, nothing of a run or a
/// study in it, a file that cannot be understood.
Report read_report(const std::vector<std::filesystem::path>& folders);

/// A page that needs no other file and no network: style, plots and pictures are in it. HTML that
/// is well-formed XML, too; the same bits for the same results.
std::string report_page(const Report& report);

Json report_json(const Report& report);

/// Titles and findings.
std::string report_text(const Report& report);

}  // namespace hyperlattice::report
