// The files of a study's folder, read for a report.
#pragma once

#include <base/csv.hpp>
#include <report/record.hpp>

namespace hyperlattice::report {

/// The content of a study's folder.
struct StudyRecord {
  std::filesystem::path folder;
  Json found;        ///< study.json
  CsvTable table;    ///< study.csv; empty if the file is missing
  std::string plot;  ///< study.svg; empty if the file is missing

  std::string title() const;
};

bool is_study(const std::filesystem::path& folder);

/// Reads a study. Adds a fault for each file with invalid content.
StudyRecord read_study_record(const std::filesystem::path& folder, Faults& faults);

}  // namespace hyperlattice::report
