// Memory and disk space that this process can still get, for checks before a request.
#pragma once

#include <filesystem>
#include <string>

namespace hyperlattice {

/// An available amount and its limit.
struct Room {
  /// available amount, bytes
  double bytes = 0;
  std::string bound;  ///< the limit, in words: "the limit on the address space (ulimit -v) is ..."
};

/// Returns the smallest amount that the limits of the process, its control groups and the machine
/// leave. Caches that the kernel can free count as available, swap space does not. `root`: folder
/// of the system's files.
Room memory_room(const std::filesystem::path& root = "/");

/// Returns the free space of the file system of a path, which need not exist yet.
Room disk_room(const std::filesystem::path& path);

/// Returns the largest size of a file that the process may write; infinite without a limit.
Room file_room();

}  // namespace hyperlattice
