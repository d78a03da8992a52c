// What this process may still have of memory and disk, before it asks for it.
#pragma once

#include <filesystem>
#include <string>

namespace hyperlattice {

/// An amount that is left, and what bounds it.
struct Room {
  double bytes = 0;
  std::string bound;  ///< "the limit on address space (ulimit -v)"
};

/// The least that limits of the process, its control groups and the machine leave. What the kernel
/// can take back from its caches counts as left, space to swap to does not. `root`: where the
/// system's files are looked for.
Room memory_room(const std::filesystem::path& root = "/");

/// What the file system has left where the path is, or will be.
Room disk_room(const std::filesystem::path& path);

/// The largest file that the process may write; infinite if there is no limit.
Room file_room();

}  // namespace hyperlattice
