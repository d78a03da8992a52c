#include <process/control_group.hpp>

#include <fstream>
#include <sstream>

namespace hyperlattice {

namespace {

namespace fs = std::filesystem;

/// Returns the first number in a file; nothing if there is none, as in "max".
std::optional<double> number_in(const fs::path& file) {
  std::ifstream stream(file);
  double number = 0;
  if (!(stream >> number)) return std::nullopt;
  return number;
}

/// Returns the sum of the numbers of these keys in a file of lines "key number".
double sum_of(const fs::path& file, std::initializer_list<std::string_view> keys) {
  std::ifstream stream(file);
  double sum = 0, number = 0;
  for (std::string key; stream >> key >> number;)
    for (const std::string_view wanted : keys)
      if (key == wanted) sum += number;
  return sum;
}

/// Returns the folders from a group up to the mount of its controller. In a container the group's
/// files may be at the mount instead of at the group's path.
std::vector<fs::path> folders_of(const fs::path& mount, const fs::path& group) {
  std::error_code ignored;
  if (!fs::is_directory(mount, ignored)) return {};
  std::vector<fs::path> folders;
  for (fs::path part = group.relative_path(); !part.empty(); part = part.parent_path())
    if (fs::is_directory(mount / part, ignored)) folders.push_back(mount / part);
  folders.push_back(mount);
  return folders;
}

bool lists(const std::string& controllers, std::string_view wanted) {
  std::istringstream names(controllers);
  for (std::string name; std::getline(names, name, ',');)
    if (name == wanted) return true;
  return false;
}

std::optional<ControlGroups::Memory> memory_of(const fs::path& folder) {
  std::error_code ignored;
  const bool unified = fs::exists(folder / "memory.max", ignored);
  const auto limit = number_in(folder / (unified ? "memory.max" : "memory.limit_in_bytes"));
  const auto used = number_in(folder / (unified ? "memory.current" : "memory.usage_in_bytes"));
  if (!limit || !used) return std::nullopt;
  const double files =
      unified ? sum_of(folder / "memory.stat", {"inactive_file", "active_file", "slab_reclaimable"})
              : sum_of(folder / "memory.stat", {"total_inactive_file", "total_active_file"});
  return ControlGroups::Memory{*limit, std::max(0.0, *used - files), folder};
}

std::optional<double> processors_of(const fs::path& folder) {
  std::ifstream both(folder / "cpu.max");  // "max 100000" without a limit
  double quota = 0, period = 0;
  if (both >> quota >> period) return quota / period;
  const auto old_quota = number_in(folder / "cpu.cfs_quota_us"),
             old_period = number_in(folder / "cpu.cfs_period_us");
  if (!old_quota || !old_period || *old_quota <= 0) return std::nullopt;
  return *old_quota / *old_period;
}

}  // namespace

ControlGroups::ControlGroups(const fs::path& root) {
  // lines "number:controllers:/group"; version 2 has no controllers in them
  std::ifstream stream(root / "proc/self/cgroup");
  const fs::path mounts = root / "sys/fs/cgroup";
  for (std::string line; std::getline(stream, line);) {
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const fs::path group = line.substr(second + 1);
    std::error_code ignored;
    const fs::path unified =
        fs::is_directory(mounts / "unified", ignored) ? mounts / "unified" : mounts;
    const auto add = [&](std::vector<fs::path>& folders, const char* controller) {
      if (!controllers.empty() && !lists(controllers, controller)) return;
      const fs::path named = mounts / controllers;
      const fs::path mount = controllers.empty()                ? unified
                             : fs::is_directory(named, ignored) ? named
                                                                : mounts / controller;
      for (fs::path& folder : folders_of(mount, group)) folders.push_back(std::move(folder));
    };
    add(memory_, "memory");
    add(processor_, "cpu");
  }
}

std::optional<ControlGroups::Memory> ControlGroups::memory() const {
  std::optional<Memory> tightest;
  for (const fs::path& folder : memory_)
    if (const auto memory = memory_of(folder);
        memory && (!tightest || memory->limit - memory->used < tightest->limit - tightest->used))
      tightest = memory;
  return tightest;
}

std::optional<double> ControlGroups::processors() const {
  std::optional<double> least;
  for (const fs::path& folder : processor_)
    if (const auto granted = processors_of(folder); granted && (!least || *granted < *least))
      least = granted;
  return least;
}

}  // namespace hyperlattice
