// A whole study: its runs, what they show, and the files of its results.
#pragma once

#include <study/report.hpp>
#include <study/study_runs.hpp>

namespace hyperlattice::study {

struct PerformedStudy {
  StudyResult done;
  Findings findings;
};

/// Runs a study, evaluates it, and writes study.csv, study.json and, with gnuplot, study.svg into
/// its folder. Throws as run_study() does.
PerformedStudy perform(const Study& study, const StudyRunOptions& options, Host& host);

}  // namespace hyperlattice::study
