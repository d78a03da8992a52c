// Finds the use of a folder: results of a run or of a study. They do not share a folder.
#pragma once

#include <filesystem>
#include <string>

namespace hyperlattice {

/// Returns whether a study left its results in the folder: a study.json that has rows.
bool has_study(const std::filesystem::path& folder);

/// Returns what the folder has of a study, as a clause: "a study is running there"; "": nothing.
std::string study_in(const std::filesystem::path& folder);

/// Returns what the folder has of a run, as a clause; "": nothing.
std::string run_in(const std::filesystem::path& folder);

/// Returns whether a run is writing into the folder now.
bool is_written(const std::filesystem::path& folder);

}  // namespace hyperlattice
