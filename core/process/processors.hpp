// How many processors this process may use.
#pragma once

#include <filesystem>

namespace hyperlattice {

/// Those that its affinity mask names, or fewer if its control group grants less time than they
/// have; at least 1. `root`: where the system's files are looked for.
int processors(const std::filesystem::path& root = "/");

}  // namespace hyperlattice
