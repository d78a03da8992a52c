#include <report/facts.hpp>
#include <report/report.hpp>
#include <report/verdict.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <iterator>

namespace hyperlattice::report {

namespace fs = std::filesystem;

namespace {

/// Labels each run with the last part of its folder's path, or with the whole path if two runs have
/// the same last part.
void label(std::vector<RunRecord>& runs) {
  const auto last_part = [](const fs::path& folder) {
    const fs::path whole = fs::absolute(folder).lexically_normal();
    return (whole.has_filename() ? whole.filename() : whole.parent_path().filename()).string();
  };
  for (RunRecord& run : runs) {
    const auto alike = std::count_if(runs.begin(), runs.end(), [&](const RunRecord& other) {
      return last_part(other.folder) == last_part(run.folder);
    });
    run.label = alike > 1 ? run.folder.string() : last_part(run.folder);
  }
}

}  // namespace

Report read_report(const std::vector<fs::path>& folders) {
  Report report;
  Faults faults;
  std::vector<fs::path> seen;
  for (const fs::path& folder : folders) {
    std::error_code unreadable;
    if (!fs::is_directory(folder, unreadable)) {
      faults.add(folder.string(), "", "a folder with what a run left");
      continue;
    }
    const fs::path whole = fs::canonical(folder);
    if (std::find(seen.begin(), seen.end(), whole) != seen.end()) {
      faults.add(folder.string(), "", "each folder once");
      continue;
    }
    seen.push_back(whole);
    if (is_run(folder))
      report.runs.push_back(read_run(folder, faults));
    else if (is_study(folder))
      report.studies.push_back(read_study_record(folder, faults));
    else
      faults.add(folder.string(), "",
                 "a run's summary.json or history.csv in it, or a study's study.json");
  }
  faults.throw_if_any();
  label(report.runs);
  std::vector<Json> scenes;
  for (const RunRecord& run : report.runs) scenes.push_back(run.scene);
  report.differing = differences(scenes);
  return report;
}

Json report_json(const Report& report) {
  Json json = {{"runs", Json::array()}, {"differences", Json::array()}, {"studies", Json::array()}};
  for (const RunRecord& record : report.runs) {
    Json run = {{"folder", record.folder.string()},
                {"label", record.label},
                {"title", record.title()},
                {"status", record.status()},
                {"findings", Json::array()}};
    for (const Finding& finding : verdict(record))
      run["findings"].push_back(
          {{"about", finding.about},
           {"judgement", judgement_names[static_cast<std::size_t>(finding.judgement)]},
           {"sentence", finding.sentence},
           {"numbers", finding.numbers}});
    run["figures"] = figures(record);
    json["runs"].push_back(std::move(run));
  }
  for (const Difference& difference : report.differing)
    json["differences"].push_back({{"pointer", difference.pointer}, {"values", difference.values}});
  for (const StudyRecord& study : report.studies)
    json["studies"].push_back(
        {{"folder", study.folder.string()}, {"title", study.title()}, {"found", study.found}});
  return json;
}

std::string report_text(const Report& report) {
  std::string text;
  for (const RunRecord& record : report.runs) {
    fmt::format_to(std::back_inserter(text), "{}{}: {}\n", text.empty() ? "" : "\n", record.title(),
                   record.status());
    for (const Finding& finding : verdict(record))
      fmt::format_to(std::back_inserter(text), "  {}\n", finding.sentence);
  }
  for (const StudyRecord& study : report.studies)
    fmt::format_to(std::back_inserter(text), "{}{}: a study\n", text.empty() ? "" : "\n",
                   study.title());
  return text;
}

}  // namespace hyperlattice::report
