#include <base/input_file.hpp>
#include <report/study_record.hpp>

namespace hyperlattice::report {

namespace fs = std::filesystem;

namespace {

std::string text_of(const fs::path& file) { return fs::exists(file) ? read_input_file(file, file.string(), "a file") : std::string(); }

}  // namespace

std::string StudyRecord::title() const {
  const std::string title = word_in(found, "title");
  return title.empty() ? folder.string() : title;
}

bool is_study(const fs::path& folder) { return fs::exists(folder / "study.json"); }

StudyRecord read_study_record(const fs::path& folder, Faults& faults) {
  StudyRecord study{folder, read_json_object(folder / "study.json", faults), parse_csv(text_of(folder / "study.csv")), text_of(folder / "study.svg")};
  if (study.found.is_object() && !study.found.contains("rows"))
    faults.add((folder / "study.json").string(), "", "the results of a study, with \"rows\"");
  return study;
}

}  // namespace hyperlattice::report
