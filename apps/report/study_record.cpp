#include <base/folder_file.hpp>
#include <report/study_record.hpp>

namespace hyperlattice::report {

namespace fs = std::filesystem;

std::string StudyRecord::title() const {
  const std::string title = word_in(found, "title");
  return title.empty() ? folder.string() : title;
}

bool is_study(const fs::path& folder) { return has_folder_file(folder, "study.json"); }

StudyRecord read_study_record(const fs::path& folder, Faults& faults) {
  StudyRecord study{folder, read_json_object(folder, "study.json", faults), {}, ""};
  study.table = parse_csv(read_text(folder, "study.csv", largest_table, faults).value_or(""));
  study.plot = read_text(folder, "study.svg", largest_picture, faults).value_or("");
  if (study.found.is_object() && !study.found.contains("rows"))
    faults.add((folder / "study.json").string(), "", "the results of a study, with \"rows\"");
  return study;
}

}  // namespace hyperlattice::report
