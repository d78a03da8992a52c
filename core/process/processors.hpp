// Number of processors that this process may use.
#pragma once

#include <filesystem>

namespace hyperlattice {

/// Returns the number of processors in the affinity mask, or less if the control group grants less
/// processor time; at least 1. `root`: folder of the system's files.
int processors(const std::filesystem::path& root = "/");
/// Returns the number for each of so many processes that share the machine: this process may be
/// bound to processors of its own, or to all.
int processors_of_each(int processes);

}  // namespace hyperlattice
