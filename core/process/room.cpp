#include <base/figures.hpp>
#include <process/control_group.hpp>
#include <process/room.hpp>

#include <sys/resource.h>
#include <sys/statvfs.h>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <fstream>
#include <limits>

namespace hyperlattice {

namespace {

namespace fs = std::filesystem;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Returns the number after a key such as "VmSize:" in a file of the system, converted from kB to
/// bytes.
double kilobytes_in(const fs::path& file, std::string_view key, double otherwise) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with(key)) return 1024 * std::stod(line.substr(key.size()));
  return otherwise;
}

double limit_of(decltype(RLIMIT_AS) resource) {
  struct rlimit limit {};
  if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return infinite;
  return static_cast<double>(limit.rlim_cur);
}

}  // namespace

Room memory_room(const fs::path& root) {
  Room least{infinite, ""};
  const auto consider = [&](double limit, double used, const auto& bound) {
    const double left = std::max(0.0, limit - used);
    if (left < least.bytes)
      least = {left, fmt::format("{} is {}, {} of it in use", bound, bytes_text(limit),
                                 bytes_text(used))};
  };
  const fs::path status = root / "proc/self/status";
  if (const double limit = limit_of(RLIMIT_AS); limit < infinite)
    consider(limit, kilobytes_in(status, "VmSize:", 0),
             "the limit on the address space (ulimit -v)");
  if (const double limit = limit_of(RLIMIT_DATA); limit < infinite)
    consider(limit, kilobytes_in(status, "VmData:", 0), "the limit on data (ulimit -d)");
  if (const auto group = ControlGroups(root).memory())
    consider(group->limit, group->used,
             fmt::format("the memory limit of the control group {}", group->group.string()));
  const double machine = kilobytes_in(root / "proc/meminfo", "MemTotal:", 0),
               available = kilobytes_in(root / "proc/meminfo", "MemAvailable:", infinite);
  if (available < infinite) consider(machine, machine - available, "the memory of this machine");
  return least;
}

Room disk_room(const fs::path& path) {
  std::error_code ignored;
  fs::path there = fs::absolute(path, ignored);
  while (!fs::exists(there, ignored) && there.has_relative_path()) there = there.parent_path();
  struct statvfs system {};
  if (statvfs(there.c_str(), &system) != 0) return {infinite, ""};
  const double left = static_cast<double>(system.f_bavail) * static_cast<double>(system.f_frsize);
  return {left, fmt::format("the file system of {} has {} left", there.string(), bytes_text(left))};
}

Room file_room() {
  const double limit = limit_of(RLIMIT_FSIZE);
  return {limit,
          fmt::format("the limit on the size of files (ulimit -f) is {}", bytes_text(limit))};
}

}  // namespace hyperlattice
