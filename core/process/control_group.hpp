// What the control groups of this process allow it, of either version of them: containers and batch
// systems set such limits.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hyperlattice {

class ControlGroups {
 public:
  /// The limits of this process. `root`: where the system's files are looked for. A file that
  /// cannot be read sets no limit.
  explicit ControlGroups(const std::filesystem::path& root = "/");

  struct Memory {
    double limit = 0, used = 0;   ///< bytes; what the kernel can take back is not counted as used
    std::filesystem::path group;  ///< the folder whose limit it is
  };
  std::optional<Memory> memory() const;      ///< of the group that has the least left
  std::optional<double> processors() const;  ///< time that the tightest group grants, in processors

 private:
  /// The folders of the process's own group and those above it, for one controller.
  std::vector<std::filesystem::path> memory_, processor_;
};

}  // namespace hyperlattice
