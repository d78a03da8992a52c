#include <base/errors.hpp>
#include <base/figures.hpp>
#include <plan/estimates.hpp>
#include <plan/shortage.hpp>
#include <process/room.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace hyperlattice {

namespace {

/// What an earlier run left in the folder makes room when it goes.
double bytes_in(const std::filesystem::path& directory) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  double bytes = 0;
  for (auto entry = fs::recursive_directory_iterator(directory, fs::directory_options::skip_permission_denied, ignored);
       entry != fs::recursive_directory_iterator(); entry.increment(ignored))
    if (entry->is_regular_file(ignored) && !entry->is_symlink(ignored)) bytes += static_cast<double>(entry->file_size(ignored));
  return bytes;
}

}  // namespace

std::vector<std::string> shortages(const Plan& plan, const std::filesystem::path& directory) {
  std::vector<std::string> found;
  const double missing = plan.memory_bytes - model_bytes(*plan.model);
  if (const Room memory = memory_room(); missing > memory.bytes)
    found.push_back(fmt::format("too little memory: the run needs {}, {} more than it has now; there are {} ({})", bytes_text(plan.memory_bytes),
                                bytes_text(missing), bytes_text(memory.bytes), memory.bound));
  if (const Room disk = disk_room(directory); plan.output_bytes > disk.bytes + bytes_in(directory))
    found.push_back(fmt::format("too little disk: the run will write about {}, and {}", bytes_text(plan.output_bytes), disk.bound));
  double frame = 0;
  for (const Stage* writer : plan.scene->of(Family::writers)) frame = std::max(frame, frame_bytes(plan, *writer));
  if (const Room file = file_room(); frame > file.bytes)
    found.push_back(fmt::format("too small files: a frame will have about {}, and {}", bytes_text(frame), file.bound));
  return found;
}

void refuse_shortage(const Plan& plan, const std::filesystem::path& directory) {
  const std::vector<std::string> found = shortages(plan, directory);
  if (!found.empty()) throw OutsideError(fmt::format("nothing was written; {}", fmt::join(found, "\n")));
}

}  // namespace hyperlattice
