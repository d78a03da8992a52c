// Whether a run has the room that its plan says it needs.
#pragma once

#include <plan/plan.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace hyperlattice {

/// Sentences, one for each thing that this process has too little of for the run: memory that is
/// not allocated yet, disk where the results go, or the size of a file. Each has what the run needs
/// and what there is. Empty if all fits. The files of an earlier run in `directory`, which the run
/// replaces, count as free disk.
std::vector<std::string> shortages(const Plan& plan, const std::filesystem::path& directory);

/// OutsideError with these sentences if there are any.
void refuse_shortage(const Plan& plan, const std::filesystem::path& directory);

}  // namespace hyperlattice
