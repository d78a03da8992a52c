#include <base/errors.hpp>
#include <base/figures.hpp>
#include <base/own_files.hpp>
#include <plan/estimates.hpp>
#include <plan/shortage.hpp>
#include <process/room.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace hyperlattice {

namespace {

/// Returns the bytes of the files in an earlier run's list: a new run replaces them, a resumed run
/// has written them already. An unreadable list counts as empty; the run reports it.
double own_bytes(const std::filesystem::path& directory) {
  namespace fs = std::filesystem;
  double bytes = 0;
  try {
    const std::optional<OwnFiles> files = read_own_files(directory);
    if (!files) return 0;
    for (const auto& [name, file] : *files) {
      std::error_code error;
      const fs::path path = directory / name;
      if (!fs::is_regular_file(fs::symlink_status(path, error))) continue;
      const std::uintmax_t size = fs::file_size(path, error);
      if (!error) bytes += static_cast<double>(size);
    }
  } catch (const OutsideError&) {  // nothing is known of the files
  }
  return bytes;
}

/// The fraction of an estimate that a run normally writes at least. A run that may fit is not
/// refused.
constexpr double surely = 0.7;

}  // namespace

std::vector<std::string> shortages(const Plan& plan, const std::filesystem::path& directory) {
  std::vector<std::string> found;
  const double missing = plan.memory_bytes - allocated_bytes(*plan.model);
  if (const Room memory = memory_room(); missing > memory.bytes)
    found.push_back(fmt::format(
        "too little memory: the run needs {}, {} more than it has now; there are {} ({})",
        bytes_text(plan.memory_bytes), bytes_text(missing), bytes_text(memory.bytes),
        memory.bound));
  if (const Room disk = disk_room(directory);
      surely * plan.output_bytes > disk.bytes &&
      surely * plan.output_bytes > disk.bytes + own_bytes(directory))
    found.push_back(fmt::format("too little disk: the run will write about {}, and {}",
                                bytes_text(plan.output_bytes), disk.bound));
  double frame = 0;
  for (const Stage* writer : plan.scene->of(Family::writers))
    frame = std::max(frame, frame_bytes(plan, *writer));
  if (const Room file = file_room(); surely * frame > file.bytes)
    found.push_back(fmt::format("too small files: a frame will have about {}, and {}",
                                bytes_text(frame), file.bound));
  return found;
}

void refuse_shortage(const Plan& plan, const std::filesystem::path& directory) {
  const std::vector<std::string> found = shortages(plan, directory);
  if (!found.empty())
    throw OutsideError(fmt::format("nothing was written; {}", fmt::join(found, "\n")));
}

}  // namespace hyperlattice
