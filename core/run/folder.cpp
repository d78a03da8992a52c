#include <base/folder_file.hpp>
#include <plan/file_names.hpp>
#include <run/checkpoint.hpp>
#include <run/failing_motion.hpp>
#include <run/final_state.hpp>
#include <run/folder.hpp>
#include <run/occupancy.hpp>

#include <hyperlattice/files.hpp>

#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace hyperlattice {

namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::generic_category().message(error); }

/// Returns whether a name leads to a regular file through real folders only, no links.
bool is_real(const fs::path& directory, const std::string& name, struct stat& status) {
  fs::path path = directory;
  for (const fs::path& part : fs::path(name)) {
    if (path != directory && !S_ISDIR(status.st_mode)) return false;
    path /= part;
    if (::lstat(path.c_str(), &status) != 0) return false;
  }
  return S_ISREG(status.st_mode);
}

bool is_later(const timespec& a, const timespec& b) {
  return a.tv_sec != b.tv_sec ? a.tv_sec > b.tv_sec : a.tv_nsec > b.tv_nsec;
}

/// Returns whether this is the name of a temporary file of AtomicFile: "<name>.<16 hexadecimal
/// digits>.part".
bool is_part(const std::string& name) {
  constexpr std::size_t digits = 16, ending = 5;
  if (!name.ends_with(".part") || name.size() < digits + ending + 2) return false;
  const std::string number = name.substr(name.size() - digits - ending, digits);
  return name[name.size() - digits - ending - 1] == '.' &&
         number.find_first_not_of("0123456789abcdef") == std::string::npos;
}

constexpr const char* ends[] = {"summary.json", failing_motion_file};

/// Returns whether a file says how the run ended; a resumed run removes such files.
bool tells_the_end(const std::string& name) {
  return std::find(std::begin(ends), std::end(ends), name) != std::end(ends);
}

OutsideError cannot(const char* what, const fs::path& path, int error) {
  return OutsideError(fmt::format("cannot {} {}: {}", what, path.string(), reason(error)));
}

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error)
    throw OutsideError(fmt::format("cannot create {}: {}", path.string(), error.message()));
}

}  // namespace

RunFolder::RunFolder(fs::path directory, bool is_new) : directory_(std::move(directory)) {
  if (const std::string study = is_new ? study_in(directory_) : ""; !study.empty())
    throw InputError(
        {{"--out", directory_.string(), fmt::format("another folder than a study's; {}", study)}});
  if (is_new) make_folder(directory_);
  if (struct stat status{}; ::lstat(list_path().c_str(), &status) == 0 && !S_ISREG(status.st_mode))
    throw InputError({{"--out", list_path().string(),
                       "a regular file, or nothing, of that name: --overwrite replaces no folder, "
                       "link, pipe or device"}});
  constexpr int flags = O_RDWR | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  Descriptor list(::open(list_path().c_str(), flags | (is_new ? O_CREAT : 0), 0666));
  if (!list) throw cannot("write", list_path(), errno);
  if (::flock(list.number(), LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK)
      throw OutsideError(
          fmt::format("{} is in use: another run is writing there; wait until it ends, or choose "
                      "another folder",
                      directory_.string()));
    spdlog::warn("warning: {} cannot be locked ({}): let no other run write there",
                 directory_.string(), reason(errno));
  }
  struct stat status {};
  if (::fstat(list.number(), &status) != 0) throw cannot("read", list_path(), errno);
  if (!S_ISREG(status.st_mode))
    throw OutsideError(fmt::format("{} is no regular file", list_path().string()));
  // Another run may have opened the list first and removed it since.
  struct stat named {};
  if (::lstat(list_path().c_str(), &named) != 0 || named.st_ino != status.st_ino ||
      named.st_dev != status.st_dev)
    throw OutsideError(
        fmt::format("{} was removed while it was opened: run again", list_path().string()));
  if (auto files = read_own_files(directory_)) earlier_ = std::move(*files);
  list_ = std::make_unique<Table>(list_path(), std::move(list),
                                  static_cast<std::uint64_t>(status.st_size));
}

/// Returns the names of files that the run may write or remove and that may exist.
std::set<std::string> RunFolder::met(const std::vector<OutputName>& outputs, Faults& faults) const {
  std::set<std::string> names;
  for (const std::string_view name : run_file_names)
    if (name != "probes" && name != "report.html") names.emplace(name);
  for (const auto& [name, file] : earlier_)
    if (struct stat status{}; is_real(directory_, name, status)) names.insert(name);
  std::set<std::string> folders;
  for (const OutputName& output : outputs) folders.insert(output.folder);
  for (const std::string& folder : folders) {
    struct stat status {};
    if (!folder.empty() && ::lstat(path_of(folder).c_str(), &status) == 0 &&
        !S_ISDIR(status.st_mode)) {
      faults.add("--out", path_of(folder).string(),
                 "a folder, or nothing, of that name; a file or link is there, which --overwrite "
                 "does not replace");
      continue;
    }
    std::error_code error;
    for (fs::directory_iterator entry(path_of(folder), error), end; !error && entry != end;
         entry.increment(error)) {
      const std::string name = entry->path().filename().string();
      if (std::any_of(outputs.begin(), outputs.end(), [&](const OutputName& output) {
            return output.folder == folder && output.may_be(name);
          }))
        names.insert(folder.empty() ? name : folder + "/" + name);
    }
  }
  return names;
}

void RunFolder::refuse_losses(const std::set<std::string>& names,
                              const std::vector<fs::path>& inputs, bool overwrite,
                              Faults& faults) const {
  std::set<std::pair<dev_t, ino_t>> read;
  for (const fs::path& input : inputs)
    if (struct stat status{}; ::stat(input.c_str(), &status) == 0)
      read.emplace(status.st_dev, status.st_ino);
  for (const std::string& name : names) {
    const fs::path path = path_of(name);
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0) continue;
    const bool needs_no_list =
        name == own_files_list || name == checkpoint_file || name == earlier_checkpoint_file;
    if (!S_ISREG(status.st_mode))
      faults.add("--out", path.string(),
                 "a regular file, or nothing, of that name: --overwrite replaces no folder, link, "
                 "pipe or device");
    else if (read.count({status.st_dev, status.st_ino}) > 0)
      faults.add("--out", path.string(),
                 "a folder in which the run replaces nothing that it needs; the scene reads it, or "
                 "it is the scene");
    else if (!overwrite && !needs_no_list && earlier_.find(name) == earlier_.end())
      faults.add("--out", path.string(),
                 fmt::format("a folder where no such file is, for its list of a run's own files "
                             "({}) does not name it; move the file, or replace it "
                             "by --overwrite",
                             own_files_list));
  }
}

void RunFolder::begin(bool overwrite, const std::vector<OutputName>& outputs,
                      const std::vector<fs::path>& inputs) {
  may_replace_ = overwrite;
  Faults faults;
  if (!overwrite && holds_progress(directory_) && !is_done(directory_))
    faults.add("--out", directory_.string(),
               "a folder without an interrupted run; go on with it by --resume, or give up its "
               "results by --overwrite");
  refuse_losses(met(outputs, faults), inputs, overwrite, faults);
  try {
    remove_earlier_files(earlier_, overwrite, faults);
  } catch (const InputError&) {
    if (list_->extent().bytes == 0) ::unlink(list_path().c_str());  // leave no empty list
    throw;
  }
  list_->cut(0);
  list_->lines("bytes,hash,name\n");
  earlier_.clear();
}

void RunFolder::remove_earlier_files(const OwnFiles& files, bool overwrite, Faults& faults) {
  struct stat list {};
  ::lstat(list_path().c_str(), &list);
  std::vector<fs::path> old;
  std::set<fs::path> folders{directory_};
  for (const auto& [name, file] : files) {
    struct stat status {};
    if (!is_real(directory_, name, status)) continue;
    const fs::path path = path_of(name);
    folders.insert(path.parent_path());
    // A file that has not changed since the list was written need not be read: no program can set
    // the time of the last change of status. (A copy of the folder gives the list a new time, and
    // so hides earlier changes.)
    const bool is_known =
        file.hash.empty() ||
        (static_cast<std::uint64_t>(status.st_size) == file.bytes &&
         (!is_later(status.st_ctim, list.st_ctim) || has_extent(path, {file.bytes, file.hash})));
    if (is_known || overwrite)
      old.push_back(path);
    else
      faults.add(
          "--out", path.string(),
          "as the earlier run left it, but it has changed; move it, or replace it by --overwrite");
  }
  faults.throw_if_any();
  for (const char* name : {checkpoint_file, earlier_checkpoint_file})
    old.push_back(directory_ / name);
  for (const fs::path& path : old)
    if (::unlink(path.c_str()) != 0 && errno != ENOENT) throw cannot("remove", path, errno);
  // The innermost folder first.
  for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder) {
    remove_parts(*folder);
    if (*folder != directory_) ::rmdir(folder->c_str());  // fails if other files are in it
  }
}

void RunFolder::remove_parts(const fs::path& folder) const {
  std::error_code error;
  std::vector<fs::path> parts;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (is_part(entry->path().filename().string())) parts.push_back(entry->path());
  for (const fs::path& part : parts) ::unlink(part.c_str());
}

void RunFolder::go_on(std::vector<TableMark> marks, const std::vector<OutputName>& outputs) {
  may_replace_ = true;  // frames from after the checkpoint are written again
  Faults faults;
  std::uint64_t listed = 0;
  std::set<std::string, std::less<>> tables;
  for (const TableMark& mark : marks) {
    const bool is_list = mark.name == own_files_list;
    struct stat status {};
    tables.insert(mark.name);
    if ((is_list || is_own_name(mark.name)) && is_real(directory_, mark.name, status) &&
        has_extent(path_of(mark.name), mark.extent)) {
      if (is_list) listed = mark.extent.bytes;
      continue;
    }
    faults.add("--resume", path_of(mark.name).string(),
               "a table that begins as it did when the checkpoint was made; it was cut, changed or "
               "removed");
  }
  std::ifstream list(list_path(), std::ios::binary);
  std::string text(listed, '\0');
  list.read(text.data(), static_cast<std::streamsize>(text.size()));
  for (const auto& [name, file] : parse_own_files(text)) {
    if (tables.count(name) > 0 || tells_the_end(name)) continue;
    struct stat status {};
    const bool is_same =
        is_real(directory_, name, status) &&
        (file.hash.empty() || (static_cast<std::uint64_t>(status.st_size) == file.bytes &&
                               has_extent(path_of(name), {file.bytes, file.hash})));
    files_[name] = {file.hash.empty(), !file.hash.empty()};
    if (!is_same)
      faults.add("--resume", path_of(name).string(),
                 "a file as it was when the checkpoint was made; it was changed or removed");
  }
  refuse_losses(met(outputs, faults), {}, true, faults);
  faults.throw_if_any();
  marks_ = std::move(marks);
  // They say how the run ended before.
  for (const char* name : ends)
    if (::unlink(path_of(name).c_str()) != 0 && errno != ENOENT)
      throw cannot("remove", path_of(name), errno);
  std::set<fs::path> folders{directory_};
  for (const auto& [name, file] : files_) folders.insert(path_of(name).parent_path());
  for (const fs::path& folder : folders) remove_parts(folder);
  list_->cut(listed);
  // Files written after the checkpoint are the run's, but will be written again.
  for (const auto& [name, file] : earlier_) {
    if (files_.count(name) > 0 || tables.count(name) > 0) continue;
    list_->lines(own_file_line(name, {}));
    files_[name] = {true, false};
  }
}

fs::path RunFolder::subfolder(const std::string& name) {
  fs::path path = path_of(name);
  struct stat status {};
  if (::mkdir(path.c_str(), 0777) != 0 && errno != EEXIST) throw cannot("create", path, errno);
  if (::lstat(path.c_str(), &status) != 0) throw cannot("create", path, errno);
  if (!S_ISDIR(status.st_mode))
    throw OutsideError(fmt::format(
        "cannot create the folder {}: a file or link of that name is there", path.string()));
  return path;
}

Table& RunFolder::table(const std::string& name, const std::vector<std::string>& columns) {
  if (!list_) return tables_.emplace_back(name, Table::nowhere()).second;
  const auto mark = std::find_if(marks_.begin(), marks_.end(),
                                 [&](const TableMark& one) { return one.name == name; });
  claim(name, true);
  return tables_
      .emplace_back(name, mark == marks_.end() ? Table(path_of(name), columns)
                                               : Table::resumed(path_of(name), mark->extent.bytes))
      .second;
}

void RunFolder::write(const std::string& name, std::string_view text) {
  if (!list_) return;
  claim(name, false);
  try {
    write_file(path_of(name).string(), text);
  } catch (const std::runtime_error& error) {
    throw OutsideError(error.what());
  }
}

void RunFolder::claim(const std::string& name, bool rewritten) {
  if (!list_) return;
  if (!is_own_name(name))
    throw OutsideError(fmt::format("\"{}\" cannot be the name of a file of the run", name));
  const std::lock_guard lock(claiming_);
  const auto found = files_.find(name);
  if (found != files_.end() && !found->second.noted) {
    found->second.rewritten = rewritten;
    return;
  }
  if (found == files_.end() && !may_replace_ && is_there(path_of(name)))
    throw OutsideError(fmt::format(
        "{} is there already and is not this run's: move it, or replace it by --overwrite",
        path_of(name).string()));
  list_->lines(own_file_line(name, {}));
  files_[name] = {rewritten, false};
}

void RunFolder::note(const std::string& name, ListedFile& file, bool to_the_disk) {
  const fs::path path = path_of(name);
  const Descriptor there(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (!there || ::fstat(there.number(), &status) != 0 || !S_ISREG(status.st_mode))
    return;  // reserved, but never written
  if (to_the_disk && ::fsync(there.number()) != 0) throw cannot("write", path, errno);
  if (to_the_disk && file.rewritten) return;
  list_->lines(
      own_file_line(name, {static_cast<std::uint64_t>(status.st_size), hash_of_file(path)}));
  file.noted = true;
}

std::vector<TableMark> RunFolder::sync() {
  std::vector<TableMark> marks;
  std::set<fs::path> folders{directory_};
  for (auto& [name, table] : tables_) {
    table.sync();
    marks.push_back({name, table.extent()});
    folders.insert(path_of(name).parent_path());
  }
  const auto is_table = [&](const std::string& name) {
    return std::any_of(tables_.begin(), tables_.end(),
                       [&](const auto& one) { return one.first == name; });
  };
  for (auto& [name, file] : files_) {
    if (file.noted || is_table(name)) continue;
    note(name, file, true);
    folders.insert(path_of(name).parent_path());
  }
  list_->sync();
  for (const fs::path& folder : folders) sync_directory(folder);
  marks.push_back({own_files_list, list_->extent()});
  return marks;
}

void RunFolder::check_tables() const {
  if (!list_) return;
  list_->check();
  for (const auto& [name, table] : tables_) table.check();
}

void RunFolder::finish() {
  for (auto& [name, file] : files_)
    if (!file.noted) note(name, file, false);
}

}  // namespace hyperlattice
