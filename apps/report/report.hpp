// A report of runs and studies: one page for people, and the same numbers as JSON.
#pragma once

#include <report/differences.hpp>
#include <report/study_record.hpp>

namespace hyperlattice::report {

/// The content of a report.
struct Report {
  std::vector<RunRecord> runs;
  std::vector<StudyRecord> studies;
  std::vector<Difference> differing;  ///< differences between the scenes of the runs
};

/// Reads the folders. Throws InputError with every fault: a missing folder, a folder without a run
/// or a study, a file with invalid content.
Report read_report(const std::vector<std::filesystem::path>& folders);

/// Returns a page that contains its style, plots and pictures, and needs no other file and no
/// network. The page is HTML and also well-formed XML; the same results give the same bytes. `last`
/// is a last section (viewer.hpp), or empty.
std::string report_page(const Report& report, std::string_view last = "");

Json report_json(const Report& report);

/// Returns the titles and findings as text.
std::string report_text(const Report& report);

}  // namespace hyperlattice::report
