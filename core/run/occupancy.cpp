#include <base/descriptor.hpp>
#include <base/folder_file.hpp>
#include <base/own_files.hpp>
#include <run/occupancy.hpp>

#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>

namespace hyperlattice {

namespace {

namespace fs = std::filesystem;

/// Returns whether another process holds the lock on a file or folder.
bool is_locked(const fs::path& path, int flags) {
  const Descriptor there(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | flags));
  return there && ::flock(there.number(), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

}  // namespace

bool has_study(const fs::path& folder) {
  const auto file = read_folder_file(folder, "study.json", largest_json);
  const auto found = nlohmann::json::parse(file ? file->text : "", nullptr, false);
  return found.is_object() && found.contains("rows");
}

std::string study_in(const fs::path& folder) {
  if (is_locked(folder, O_DIRECTORY)) return "a study is running there";
  return has_study(folder) ? "the results of a study are there (study.json)" : "";
}

std::string run_in(const fs::path& folder) {
  if (const auto own = read_own_files(folder); own && !own->empty())
    return "the results of a run are there (files.csv)";
  return has_folder_file(folder, "summary.json") ? "the results of a run are there (summary.json)"
                                                 : "";
}

bool is_written(const fs::path& folder) { return is_locked(folder / own_files_list, O_NOFOLLOW); }

}  // namespace hyperlattice
