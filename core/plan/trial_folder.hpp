// A folder for the files of a trial.
#pragma once

#include <base/errors.hpp>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace hyperlattice {

/// A temporary folder, removed with this object.
class TrialFolder {
 public:
  TrialFolder()
      : path_((std::filesystem::temp_directory_path() / "hyperlattice_trial_XXXXXX").string()) {
    if (::mkdtemp(path_.data()) == nullptr) throw OutsideError(path_ + ": cannot make the folder");
  }
  TrialFolder(const TrialFolder&) = delete;
  TrialFolder& operator=(const TrialFolder&) = delete;
  ~TrialFolder() {
    try {
      std::filesystem::remove_all(path_);
    } catch (...) {  // files that stay are in the system's folder for temporary ones
    }
  }
  const std::string& path() const { return path_; }

  double bytes() const {
    double bytes = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path_))
      if (entry.is_regular_file()) bytes += static_cast<double>(entry.file_size());
    return bytes;
  }

 private:
  std::string path_;
};

}  // namespace hyperlattice
