#include <base/own_files.hpp>
#include <plan/file_names.hpp>
#include <run/occupancy.hpp>
#include <run/output_file.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace hyperlattice {

namespace {

namespace fs = std::filesystem;

constexpr const char* page = "report.html";  ///< lies beside results, but is not a result

/// Returns the list of a folder; empty if it cannot be read.
OwnFiles listed_in(const fs::path& folder) {
  try {
    return read_own_files(folder).value_or(OwnFiles());
  } catch (const OutsideError&) {
    return {};
  }
}

bool has_study_in(const fs::path& folder) {
  try {
    return has_study(folder);
  } catch (const OutsideError&) {
    return false;
  }
}

template <class Names>
bool is_among(const Names& names, const std::string& name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

/// Returns how a file belongs to a run or study, as a clause; "" if it does not. `path` has no
/// links.
std::string claim_on(const fs::path& path) {
  constexpr std::string_view study_files[] = {"study.json", "study.csv", "study.svg"};
  const fs::path own_folder = path.parent_path();
  const std::string name = path.filename().string();
  for (fs::path folder = own_folder;; folder = folder.parent_path()) {
    if (const OwnFiles listed = listed_in(folder); !listed.empty()) {
      const bool is_own = folder == own_folder && name != page && is_among(run_file_names, name);
      if (is_own || listed.find(path.lexically_relative(folder).string()) != listed.end())
        return fmt::format("this one is a result of the run in {}", folder.string());
    }
    if (name != page && is_written(folder))
      return fmt::format("a run is writing in {}", folder.string());
    if (folder == folder.parent_path()) break;
  }
  return is_among(study_files, name) && has_study_in(own_folder)
             ? fmt::format("this one is a result of the study in {}", own_folder.string())
             : "";
}

bool has_ending(const fs::path& path, const std::vector<std::string>& endings) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return is_among(endings, ending);
}

}  // namespace

void check_output_file(const OutputFile& output, const std::vector<fs::path>& inputs,
                       Faults& faults) {
  const fs::path& file = output.file;
  const auto refuse = [&](const std::string& expected) {
    faults.add(output.option, file.string(), expected);
  };
  std::error_code error;
  if (const fs::file_status own = fs::symlink_status(file, error);
      output.is_default && fs::exists(own) && !fs::is_regular_file(own))
    return refuse(
        "a regular file, or nothing, of that name, which nobody gave: only a link, pipe or device "
        "that you name is written into");
  const fs::file_status status = fs::status(file, error);
  if (error == std::errc::too_many_symbolic_link_levels)
    return refuse("a file; links lead in a circle there");
  if (fs::is_directory(status)) return refuse("a file; there is a folder of that name");
  if (!fs::exists(status) && fs::is_symlink(fs::symlink_status(file, error)))
    return refuse(fmt::format("a file; this is a link to {}, where none is",
                              fs::read_symlink(file, error).string()));
  const bool is_file = fs::is_regular_file(status);
  if (fs::exists(status) && !is_file) return;
  const fs::path whole = fs::absolute(file, error),
                 path = error ? whole : fs::weakly_canonical(whole, error);
  if (error) return;  // writing the file will report it
  if (std::any_of(inputs.begin(), inputs.end(),
                  [&](const fs::path& input) { return fs::equivalent(file, input, error); }))
    return refuse("another file than those that the command reads");
  if (const std::string claim = claim_on(path); !claim.empty())
    return refuse("a file that belongs to no results; " + claim);
  if (is_file && fs::file_size(path, error) > 0 && !error && !has_ending(path, output.endings))
    refuse(fmt::format("a name that is free or ends in {}; a file of another kind is there",
                       fmt::join(output.endings, " or ")));
}

}  // namespace hyperlattice
