// Checks whether a run has the memory and disk space that its plan needs.
#pragma once

#include <plan/plan.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace hyperlattice {

/// Returns one sentence, with need and supply, for each resource that is too small for the run:
/// memory still to be allocated, disk space for the results, or the largest size of a file. Files
/// of an earlier run in `directory`, which the run replaces, count as free disk space.
std::vector<std::string> shortages(const Plan& plan, const std::filesystem::path& directory);

/// Throws OutsideError with these sentences if there are any.
void refuse_shortage(const Plan& plan, const std::filesystem::path& directory);

}  // namespace hyperlattice
