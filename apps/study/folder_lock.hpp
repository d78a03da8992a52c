// A lock on a study's folder.
#pragma once

#include <base/descriptor.hpp>

#include <filesystem>

namespace hyperlattice::study {

/// While it lives, no other study runs in the folder. It leaves no file, and ends with the process.
/// OutsideError if another study has the lock; where the file system knows no locks, it warns.
class FolderLock {
 public:
  FolderLock() = default;
  explicit FolderLock(const std::filesystem::path& folder);

 private:
  Descriptor folder_;
};

}  // namespace hyperlattice::study
