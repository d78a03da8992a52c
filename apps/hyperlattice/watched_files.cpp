#include "watched_files.hpp"

#include <base/content_hash.hpp>
#include <base/errors.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <sys/inotify.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <fstream>
#include <functional>
#include <iterator>
#include <string_view>

namespace hyperlattice {

namespace {

namespace fs = std::filesystem;

/// The largest file in which names are looked for, bytes.
constexpr std::uintmax_t largest_text = std::uintmax_t{64} << 20U;

bool is_among(const std::string& ending, std::initializer_list<std::string_view> known) {
  return std::find(known.begin(), known.end(), ending) != known.end();
}
bool is_source(const fs::path& file) {
  return is_among(file.extension().string(), {".cpp", ".cc", ".cxx", ".c++", ".hpp", ".hh", ".h"});
}
bool is_of_plugins(const fs::path& file) { return file.extension() == ".so" || is_source(file); }

/// Returns the end of a text in quotes that begins at `at`, behind its last quote.
std::size_t end_of_text(std::string_view text, std::size_t at) {
  for (++at; at < text.size() && text[at] != '"' && text[at] != '\n'; ++at)
    if (text[at] == '\\') ++at;
  return std::min(at + 1, text.size());
}

using Visit = std::function<void(const std::string& name)>;

/// Visits the texts in a JSON file with comments, which may have faults.
void visit_texts(std::string_view text, const Visit& visit) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    const std::string_view left = text.substr(at);
    if (left.starts_with("//")) {
      at = std::min(text.find('\n', at), text.size());
    } else if (left.starts_with("/*")) {
      at = std::min(text.find("*/", at + 2), text.size());
    } else if (left.front() == '"') {
      const std::size_t end = end_of_text(text, at);
      const auto name = nlohmann::json::parse(text.substr(at, end - at), nullptr, false);
      if (name.is_string()) visit(name.get<std::string>());
      at = end - 1;
    }
  }
}

/// Visits the names in lines `#include "name"` of a source file.
void visit_headers(std::string_view text, const Visit& visit) {
  constexpr std::string_view key = "#include";
  for (std::size_t at = text.find(key); at != std::string_view::npos; at = text.find(key, at)) {
    at = text.find_first_not_of(" \t", at + key.size());
    if (at == std::string_view::npos || text[at] != '"') continue;
    const std::size_t end = end_of_text(text, at);
    visit(std::string(text.substr(at + 1, end - at - 2)));
    at = end;
  }
}

}  // namespace

WatchedFiles::WatchedFiles(fs::path scene, const std::vector<std::string>& settings,
                           const std::vector<fs::path>& others)
    : scene_(std::move(scene)), events_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
  if (!events_)
    throw OutsideError(
        fmt::format("cannot watch files: {}", std::generic_category().message(errno)));
  always_ = {scene_.lexically_normal()};
  for (const fs::path& other : others) always_.insert(other.lexically_normal());
  for (const std::string& setting : settings) {
    const std::string value = setting.substr(setting.find('=') + 1);
    const auto text = nlohmann::json::parse(value, nullptr, false);
    settings_.push_back(text.is_string() ? text.get<std::string>() : value);
  }
  find_changes();
}

void WatchedFiles::forget_events() {
  std::array<char, 4096> events{};
  while (::read(events_.number(), events.data(), events.size()) > 0) {
  }
}

WatchedFiles::Status WatchedFiles::status_of(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
  return {true,
          status.st_ino,
          status.st_dev,
          static_cast<std::uint64_t>(status.st_size),
          status.st_mtim.tv_sec,
          status.st_mtim.tv_nsec};
}

void WatchedFiles::add_name(const fs::path& folder, const std::string& name, Paths& found) const {
  if (name.empty() || name.size() >= PATH_MAX || name.find('\0') != std::string::npos) return;
  const fs::path path = (folder / name).lexically_normal();
  std::error_code unreadable;
  if (!fs::is_directory(path, unreadable)) {
    if (!found.insert(path).second) return;
    if (path.extension() == ".json" || is_source(path)) add_names(path, found);
    return;
  }
  for (fs::directory_iterator entry(path, unreadable), end; !unreadable && entry != end;
       entry.increment(unreadable))
    if (is_of_plugins(entry->path())) found.insert(entry->path());
}

/// Adds the files whose names are in a file.
void WatchedFiles::add_names(const fs::path& file, Paths& found) const {
  std::error_code unreadable;
  if (const auto bytes = fs::file_size(file, unreadable); unreadable || bytes > largest_text)
    return;
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const fs::path folder = file.parent_path();
  const auto add = [&](const std::string& name) { add_name(folder, name, found); };
  if (is_source(file))
    visit_headers(text, add);
  else
    visit_texts(text, add);
}

WatchedFiles::Paths WatchedFiles::named_files() const {
  Paths found = always_;
  add_names(scene_, found);
  for (const std::string& setting : settings_) add_name(scene_.parent_path(), setting, found);
  return found;
}

/// Watches the folders of all known files. A folder that is watched already stays so.
void WatchedFiles::watch_folders() {
  std::set<fs::path> folders;
  for (const auto& [file, known] : known_)
    folders.insert(file.has_parent_path() ? file.parent_path() : fs::path("."));
  constexpr std::uint32_t changes =
      IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_CREATE | IN_DELETE | IN_ONLYDIR;
  for (const fs::path& folder : folders)
    // A folder that cannot be watched, or does not exist, is seen by seem_changed().
    ::inotify_add_watch(events_.number(), folder.c_str(), changes);
}

bool WatchedFiles::seem_changed() const {
  return std::any_of(known_.begin(), known_.end(), [](const auto& entry) {
    return status_of(entry.first) != entry.second.status;
  });
}

std::vector<fs::path> WatchedFiles::find_changes() {
  std::map<fs::path, Known> before = std::move(known_);
  known_.clear();
  std::vector<fs::path> changed;
  Paths files = named_files();
  for (const auto& [file, known] : before) files.insert(file);  // a name may be gone with its file
  for (const fs::path& file : files) {
    Known now{status_of(file), {}};
    const auto known = before.find(file);
    if (known != before.end() && known->second.status == now.status) {
      now.content = known->second.content;
    } else if (now.status.exists) {
      try {
        now.content = hash_of_file(file);
      } catch (const OutsideError&) {  // it was removed since, or may not be read
        now.status = {};
      }
    }
    if (known != before.end() && known->second.content != now.content) changed.push_back(file);
    known_.emplace(file, std::move(now));
  }
  watch_folders();
  return changed;
}

}  // namespace hyperlattice
