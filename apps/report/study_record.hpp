// What a study left in its folder, read for a report.
#pragma once

#include <base/csv.hpp>
#include <report/record.hpp>

namespace hyperlattice::report {

struct StudyRecord {
  std::filesystem::path folder;
  Json found;        ///< study.json
  CsvTable table;    ///< study.csv; empty if it is not there
  std::string plot;  ///< study.svg; empty if it is not there

  std::string title() const;
};

bool is_study(const std::filesystem::path& folder);

/// Adds a fault for what cannot be understood.
StudyRecord read_study_record(const std::filesystem::path& folder, Faults& faults);

}  // namespace hyperlattice::report
