// Limits of memory and processors by the control groups (version 1 or 2) of this process;
// containers and batch systems set such limits.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hyperlattice {

/// The control groups of this process.
class ControlGroups {
 public:
  /// Finds the groups of this process. `root`: folder of the system's files. A file that cannot be
  /// read sets no limit.
  explicit ControlGroups(const std::filesystem::path& root = "/");

  struct Memory {
    double limit = 0, used = 0;   ///< bytes; `used` excludes caches that the kernel can free
    std::filesystem::path group;  ///< folder of the group that sets the limit
  };
  /// memory of the group with the least left; nothing: no limit
  std::optional<Memory> memory() const;
  /// processor time of the tightest group, in processors; nothing: no limit
  std::optional<double> processors() const;

 private:
  /// Folders of the process's group and of the groups above it, for each controller.
  std::vector<std::filesystem::path> memory_, processor_;
};

}  // namespace hyperlattice
