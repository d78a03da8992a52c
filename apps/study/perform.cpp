#include <base/gnuplot.hpp>
#include <study/perform.hpp>
#include <study/sweep.hpp>

#include <hyperlattice/files.hpp>

#include <spdlog/spdlog.h>

namespace hyperlattice::study {

namespace {

void write_results(const Study& study, const PerformedStudy& performed,
                   const std::filesystem::path& directory) {
  const auto& [done, findings] = performed;
  write_file((directory / "study.csv").string(), study_csv(study, done.rows, findings));
  write_file((directory / "study.json").string(),
             json_text(study_json(study, done.rows, findings)));
  const std::string script =
      study.is_sweep() ? sweep_script(study, done.rows) : study_script(study, done.rows, findings);
  if (script.empty()) return;
  try {
    draw_svg(directory / "study.svg", script, 860, study.is_sweep() ? sweep_height(study) : 620);
  } catch (const OutsideError& error) {
    spdlog::warn("{}", error.what());  // only the picture is missing; the results are complete
  }
}

}  // namespace

PerformedStudy perform(const Study& study, const StudyRunOptions& options, Host& host) {
  PerformedStudy performed;
  performed.done = run_study(study, grid(study), options, host);
  auto limits = find_errors(study, options.directory, performed.done.rows);
  performed.findings = find(study, performed.done.rows, std::move(limits));
  write_results(study, performed, options.directory);
  return performed;
}

}  // namespace hyperlattice::study
