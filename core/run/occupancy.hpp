// What a folder is in use for: results of a run, or of a study, which are not put into one folder.
#pragma once

#include <filesystem>
#include <string>

namespace hyperlattice {

/// Whether a study left its results in the folder: a study.json that has rows.
bool has_study(const std::filesystem::path& folder);

/// What of a study the folder holds, as a clause: "a study is running there"; empty: nothing.
std::string study_in(const std::filesystem::path& folder);

/// What of a run the folder holds, as a clause; empty: nothing.
std::string run_in(const std::filesystem::path& folder);

/// Whether a run writes into the folder now.
bool is_written(const std::filesystem::path& folder);

}  // namespace hyperlattice
