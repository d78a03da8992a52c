// Number of processors that this process may use.
#pragma once

#include <filesystem>

namespace hyperlattice {

/// Returns the number of processors in the affinity mask, or less if the control group grants less
/// processor time; at least 1. `root`: folder of the system's files.
int processors(const std::filesystem::path& root = "/");

}  // namespace hyperlattice
