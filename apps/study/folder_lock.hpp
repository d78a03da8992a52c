// A lock on a study's folder.
#pragma once

#include <base/descriptor.hpp>

#include <filesystem>

namespace hyperlattice::study {

/// Prevents other studies from running in the folder during its life. The lock leaves no file and
/// ends with the process. Throws OutsideError if another study has the lock; warns if the file
/// system has no locks.
class FolderLock {
 public:
  FolderLock() = default;
  explicit FolderLock(const std::filesystem::path& folder);

 private:
  Descriptor folder_;
};

}  // namespace hyperlattice::study
